#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""The metrics B (stiffness) and D (discrepancy) once more, after docs/design/metrics.md.

    tests/reference/stiffness.py --lab build/release/bin/hapnet-lab

plays T2 with several algorithms, takes the curves that the lab keeps (1000 rows a second), and
computes both metrics from them in plain Python: whether the page says all that is needed. Exits
with 1 where a number differs by more than 1 %. What is due in one shared world is computed twice:
from the lab's own session, and from a world and hands of this folder (remote_proxy.py), whose
draws are others; those two are to agree within 5 %.
"""
import argparse
import cmath
import csv
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

import remote_proxy as model

# docs/design/tasks.md, T2: begin, end, frequency, and who presses.
PRESSES = [(2.0, 8.0, 0.5, "l"), (8.0, 12.0, 1.0, "l"), (12.0, 14.0, 2.0, "l"),
           (14.75, 20.75, 0.5, "r"), (20.75, 24.75, 1.0, "r"), (24.75, 26.75, 2.0, "r")]
HERTZ = (0.5, 1.0, 2.0)
ALGORITHMS = ("base", "sep", "wave", "remote-proxy")
DELAYS_MS = (100, 550)
SEED = 500001
TOLERANCE = 0.01
WORLD_TOLERANCE = 0.05
EXPERIMENT = """
title = "reference"
kind = "table1"
tasks = ["T2"]
seeds = {seeds}
first_seed = {seed}
algorithms = {algorithms}
rows_per_second = 1000
[both]
delay = "{delay}ms"
"""


def phasor(values, hertz, dt):
    """The part of a signal at a frequency, over its last whole periods."""
    period = round(1.0 / (hertz * dt))
    count = len(values) // period * period
    part = values[len(values) - count:]
    middle = sum(part) / count
    return 2.0 / count * sum((value - middle) * cmath.exp(-2j * math.pi * hertz * i * dt)
                             for i, value in enumerate(part))


def dynamic_stiffness(time, place, force, dt=1e-3):
    """-F / X by frequency and side, N/m; the first period of each press is left out."""
    found = {}
    for begin, end, hertz, side in PRESSES:
        rows = [i for i, t in enumerate(time) if begin + 1.0 / hertz - dt / 2 <= t < end - dt / 2]
        moved = phasor([place[side][i] for i in rows], hertz, dt)
        found[hertz, side] = -phasor([force[side][i] for i in rows], hertz, dt) / moved
    return found


def both(stiffness, hertz):
    return stiffness[hertz, "l"] + stiffness[hertz, "r"]


def errors(felt, due):
    """|B - B0| / |B0| by frequency, and |B| / |B0| at 1 Hz."""
    by_hertz = [abs(both(felt, f) - both(due, f)) / abs(both(due, f)) for f in HERTZ]
    return {"stiffness_error": max(by_hertz), "slow_stiffness_error": by_hertz[0],
            "stiffness_ratio": abs(both(felt, 1.0)) / abs(both(due, 1.0))}


def curves(path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    column = lambda key, scale: [scale * float(row[key]) for row in rows]
    return (column("time_s", 1.0), {side: column(f"{side}hx", 1e-3) for side in "lr"},
            {side: column(f"{side}fx", 1.0) for side in "lr"}, column("lx", 1.0),
            column("rx", 1.0))


def discrepancy(a, b):
    apart = [abs(x - y) for x, y in zip(a, b)]
    mean = sum(apart) / len(apart)
    square = sum((value - mean) ** 2 for value in apart) / len(apart)
    return {"mean_mm": mean, "std_mm": math.sqrt(square), "max_mm": max(apart)}


def stored_due(folder):
    """The dynamic stiffness in one shared world by seed, as the lab measured it."""
    due = []
    for line in (folder / "sessions.jsonl").read_text(encoding="utf-8").splitlines()[1:]:
        session = json.loads(line)
        metrics = session["metrics"]
        if session["algorithm"] == "one world" and metrics["task"] == "T2":
            due.append({(hertz, side): complex(metrics["stiffness_n_per_m"][i][s],
                                               metrics["loss_stiffness_n_per_m"][i][s])
                        for i, hertz in enumerate(HERTZ) for s, side in enumerate("lr")})
    return due


def play(lab, folder, algorithms, delay, seeds):
    """Has the lab play T2."""
    experiment = folder.with_suffix(".toml")
    experiment.write_text(EXPERIMENT.format(seed=SEED, seeds=seeds, delay=delay,
                                            algorithms=json.dumps(algorithms)), encoding="utf-8")
    subprocess.run([lab, "run", experiment, "--out", folder], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def modelled_due(seed):
    """The same of this folder's own world and hands."""
    draw = random.Random(seed)
    sides = {"l": -1, "r": 1}
    hands = {name: model.Hand("T2", side, draw) for name, side in sides.items()}
    world = model.World()
    forces = dict.fromkeys(sides, 0.0)
    time, place, force = [], {"l": [], "r": []}, {"l": [], "r": []}
    for i in range(int(model.RUNNING_S / model.TICK)):
        t = i * model.TICK
        for name, hand in hands.items():
            hand.move(t, forces[name])
        on_cube = world.tick([(sides[name], hand.reported, hand.velocity)
                              for name, hand in hands.items()])
        forces = {name: -f for name, f in zip(sides, on_cube)}
        time.append(t)
        for name, hand in hands.items():
            place[name].append(hand.reported)
            force[name].append(forces[name])
    return dynamic_stiffness(time, place, force)


def check(what, here, lab, tolerance):
    apart = abs(here - lab) / max(abs(lab), 1e-9)
    is_fine = apart <= tolerance
    print(f"{what}: {here:.4f}, the lab {lab:.4f}{'' if is_fine else '  DIFFERS'}")
    return is_fine


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lab", required=True)
    parser.add_argument("--seeds", type=int, default=10, help="of the modelled shared world")
    options = parser.parse_args()
    fine = True
    with tempfile.TemporaryDirectory() as name:
        for delay in DELAYS_MS:
            folder = pathlib.Path(name) / str(delay)
            play(options.lab, folder, ALGORITHMS, delay, 1)
            due = stored_due(folder)[0]
            with open(folder / "sessions.csv", newline="", encoding="utf-8") as file:
                rows = {row["algorithm"]: row for row in csv.DictReader(file)
                        if row["task"] == "T2"}
            for algorithm in ALGORITHMS:
                time, place, force, a, b = curves(folder / "replay" / f"{algorithm}-T2.csv")
                here = errors(dynamic_stiffness(time, place, force), due) | discrepancy(a, b)
                for key, value in here.items():
                    fine &= check(f"{algorithm} at {delay} ms, {key}", value,
                                  float(rows[algorithm][key]), TOLERANCE)
            # A soft algorithm gains nothing by comparison with its own perfect network, and a force
            # that comes a whole period late is no stiffness.
            if delay == 100 and float(rows["wave"]["stiffness_ratio"]) >= 0.5:
                fine = False
                print("wave at 100 ms renders half of what is due, or more: DIFFERS")
            if delay == 550 and rows["base"]["tier"] != "unusable":
                fine = False
                print("base at 550 ms is called usable: DIFFERS")
        world = pathlib.Path(name) / "world"
        play(options.lab, world, ["base"], 0, options.seeds)
        measured = stored_due(world)
    modelled = [modelled_due(seed) for seed in range(options.seeds)]
    for hertz in HERTZ:
        here, lab = (sum(abs(both(one, hertz)) for one in all_seeds) / len(all_seeds) / 2
                     for all_seeds in (modelled, measured))
        fine &= check(f"one shared world at {hertz} Hz, N/m", here, lab, WORLD_TOLERANCE)
    return 0 if fine else 1


if __name__ == "__main__":
    sys.exit(main())
