#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""How often the 95 % intervals of `hapnet-emulator learn` hold the truth, by series that this file
makes itself, from docs/use/regimes.md alone: two regimes that alternate, each with exponential
stays, normal delays and independent losses, all parameters drawn at random for each series.

Prints a table for people, or with --data the data of docs/results. Exits 1 when two regimes are
not found in every series, or when so few intervals hold the truth that right ones would do so one
time in a million.
"""

import argparse
import datetime
import json
import math
import pathlib
import platform
import random
import subprocess
import sys
import tempfile

SPACING_S = 0.001
FIGURES = {  # of a regime in the answer: what the truth calls it
    "stay_s": "mean stay", "loss": "loss", "delay_ms": "mean delay",
    "delay_sd_ms": "sd of the delay"}


def drawn_truth(chance):
    """Two regimes, the quicker first."""
    good = {"stay_s": chance.uniform(1, 4), "loss": chance.uniform(0.0005, 0.01),
            "delay_ms": chance.uniform(10, 30), "delay_sd_ms": chance.uniform(0.2, 1)}
    bad = {"stay_s": chance.uniform(0.1, 0.5), "loss": chance.uniform(0.1, 0.4),
           "delay_ms": chance.uniform(60, 120), "delay_sd_ms": chance.uniform(3, 10)}
    return [good, bad]


def made(truth, rows, chance):
    """A table of one-way delays, empty where a datagram is lost."""
    share_bad = truth[1]["stay_s"] / (truth[0]["stay_s"] + truth[1]["stay_s"])
    now = int(chance.random() < share_bad)
    end = chance.expovariate(1 / truth[now]["stay_s"])
    lines = ["time_s,delay_ms"]
    for n in range(rows):
        time = n * SPACING_S
        while time >= end:
            now = 1 - now
            end += chance.expovariate(1 / truth[now]["stay_s"])
        regime = truth[now]
        lost = chance.random() < regime["loss"]
        delay = max(chance.gauss(regime["delay_ms"], regime["delay_sd_ms"]), 0.001)
        lines.append(f"{time:.3f}," + ("" if lost else f"{delay:.6f}"))
    return "\n".join(lines) + "\n"


def learned(emulator, table, folder):
    file = folder / "series.csv"
    file.write_text(table, encoding="utf-8")
    answer = subprocess.run([emulator, "learn", str(file), "--one-way", "--json"],
                            capture_output=True, text=True, check=True)
    return json.loads(answer.stdout)["ways"][0]["regimes"]


def least_likely(hits, trials, share=0.95):
    """The probability that no more than `hits` of `trials` intervals hold the truth."""
    return math.fsum(math.comb(trials, k) * share**k * (1 - share)**(trials - k)
                     for k in range(hits + 1))


def data(rows, arguments, found):
    """As in docs/results/data: one value each, without a target."""
    commit = subprocess.run([arguments.emulator, "--version"], capture_output=True, text=True,
                            check=True).stdout
    return {
        "about": f"Made series of {arguments.rows} datagrams, one every millisecond, in two "
                 f"regimes: {found} of {arguments.series} were learned as two regimes.",
        "commit": commit.split("commit ")[-1].split(",")[0].strip(")\n"),
        "date": datetime.date.today().isoformat(),
        "machine": f"{platform.machine()}, {platform.system()} {platform.release()}",
        "command": f"tests/reference/regimes.py --series {arguments.series} "
                   f"--rows {arguments.rows} --seed {arguments.seed} --data",
        "rows": [{"case": case, "subject": subject, "baseline": None, "metric": metric,
                  "value": value, "baseline_value": None, "ratio": None, "target": None,
                  "direction": "max", "met": None}
                 for case, metric, hits, trials, worst in rows
                 for subject, value in (("intervals", trials), ("hold the truth", hits),
                                        ("largest error, percent", round(100 * worst, 2)))]}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("--emulator", required=True, help="the program hapnet-emulator")
    parser.add_argument("--series", type=int, default=40, help="how many (default 40)")
    parser.add_argument("--rows", type=int, default=200_000, help="datagrams of each")
    parser.add_argument("--seed", type=int, default=1, help="of the first series")
    parser.add_argument("--data", action="store_true", help="print JSON")
    arguments = parser.parse_args()

    counts = {(name, figure): [0, 0, 0.0] for name in ("good", "bad") for figure in FIGURES}
    found = 0
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(arguments.seed, arguments.seed + arguments.series):
            chance = random.Random(seed)
            truth = drawn_truth(chance)
            regimes = learned(arguments.emulator, made(truth, arguments.rows, chance),
                              pathlib.Path(folder))
            if [one["name"] for one in regimes] != ["good", "bad"]:
                print(f"seed {seed}: {len(regimes)} regimes", file=sys.stderr)
                continue
            found += 1
            for regime, true in zip(regimes, truth):
                for figure in FIGURES:
                    count = counts[regime["name"], figure]
                    says, right = regime[figure], true[figure]
                    count[0] += says["low"] <= right <= says["high"]
                    count[1] += 1
                    count[2] = max(count[2], abs(says["value"] / right - 1))
            if sys.stderr.isatty():
                print(f"\r{found} of {arguments.series} series", end="", file=sys.stderr)
    rows = [(f"regime {name}", FIGURES[figure], *count)
            for (name, figure), count in counts.items()]
    hits, trials = (sum(row[i] for row in rows) for i in (2, 3))
    if arguments.data:
        print(json.dumps(data(rows, arguments, found), indent=1))
    else:
        for case, metric, held, all_of, worst in rows:
            print(f"{case}, {metric}: {held} of {all_of} intervals hold the truth, "
                  f"largest error {100 * worst:.1f} %")
        print(f"{hits} of {trials} intervals hold the truth; two regimes in {found} of "
              f"{arguments.series} series")
    sys.exit(int(found < arguments.series or least_likely(hits, trials) < 1e-6))


if __name__ == "__main__":
    main()
