#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Where remote-proxy is weak, and what a cure gains: docs/results/data/weak-points.json.

    scripts/weak_points.py [--programs DIR] [--out DIR] [--quick] >FILE

Plays six cases and the experiment any-hand with hapnet-lab, and prints the file. A case has the
algorithms base and remote-proxy, and remote-proxy with the cure that was tried. Results stay in
--out (default build/weak-points), so that a second run plays only what is missing. --quick: one
seed, five points, about a minute; without it about seven minutes on two processors.
"""
import argparse
import csv
import json
import pathlib
import statistics
import subprocess
import sys

sys.dont_write_bytecode = True
import data_rows  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
SEEDS, FIRST_SEED = 10, 600001
SWING = 'both.delay={law="gamma",mean="100ms",sd="100ms"}'
SLOWLY = "both.correlation_time=500ms"
FAST = 'hands={name="fast",stiffness="900N/m",wander={amplitude="8mm",from="0.5Hz",to="5Hz"}}'
UNDERDAMPED = 'hands={name="underdamped",damping="1Ns/m"}'
NO_HORIZON = "algorithm.remote-proxy.ahead_max=1ms"
# Each case: its name, tasks and metrics, settings, and the settings of the cure.
CASES = (
    ("friction 0.26 N, stated as 0.13 N, 200 ms", {"T2": ["stiffness_ratio", "stiffness_error"]},
     ["both.delay=200ms", "device.stated_friction=0.13N"], ["both.delay=200ms"]),
    ("no friction, stated as 0.26 N, 200 ms", {"T2": ["stiffness_ratio", "stiffness_error"]},
     ["both.delay=200ms", "device.friction=0N", "device.stated_friction=0.26N"],
     ["both.delay=200ms", "device.friction=0N"]),
    ("10 ms there, 310 ms back", {"T1": ["mean_mm"], "T3": ["mean_mm"]},
     ["up.delay=10ms", "down.delay=310ms"],
     ["up.delay=10ms", "down.delay=310ms", "clock=synchronised:1ms"]),
    ("fast intentions, 150 ms", {"T2": ["mean_mm"], "T3": ["mean_mm"]},
     ["both.delay=150ms", FAST], ["both.delay=150ms", FAST, NO_HORIZON]),
    ("delay that swings, 100 +- 100 ms", {"T1": ["mean_mm", "vibration_mm"]},
     [SWING, SLOWLY], [SWING, SLOWLY, "playout=adaptive"]),
    ("taps of an underdamped hand, 100 ms", {"T6": ["mean_mm", "force_vibration_n"]},
     ["both.delay=100ms", UNDERDAMPED],
     ["both.delay=100ms", UNDERDAMPED, NO_HORIZON]),
)
WORDS = {"mean_mm": "mean distance, mm", "vibration_mm": "vibration, mm",
         "force_vibration_n": "force vibration, N", "stiffness_ratio": "stiffness ratio",
         "stiffness_error": "stiffness error"}


def run(options, experiment, out, settings):
    """Plays an experiment; the rows of its tasks."""
    words = [options.programs / "hapnet-lab", "run", experiment, "--out", out]
    for setting in settings:
        words += ["--set", setting]
    subprocess.run(words, check=True, stdout=sys.stderr)
    path, = pathlib.Path(out).glob("tasks*.csv")
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def case_rows(options, number, case):
    name, measured, settings, cure = case
    tasks = ", ".join(f'"{task}"' for task in measured)
    common = [f"tasks=[{tasks}]", f"first_seed={FIRST_SEED}",
              f"seeds={1 if options.quick else SEEDS}"]
    before = run(options, "table1", options.out / f"{number}-before",
                 common + ['algorithms=["base","remote-proxy"]'] + settings)
    after = run(options, "table1", options.out / f"{number}-after",
                common + ['algorithms=["remote-proxy"]'] + cure)
    rows = []
    for task, metrics in measured.items():
        for metric in metrics:
            words = f"{WORDS[metric]}"
            for subject, played in (("base", before), ("remote-proxy", before),
                                    ("remote-proxy, with the cure", after)):
                algorithm = subject.split(",")[0]
                value, = [float(one[metric]) for one in played
                          if (one["algorithm"], one["task"]) == (algorithm, task)]
                rows.append(data_rows.row(f"{name}, {task}", subject, words, value))
    return rows


def map_rows(options):
    settings = ["latin_hypercube.points=5"] if options.quick else []
    points = {}
    for one in run(options, "any-hand", options.out / "any-hand", settings):
        points.setdefault((one["task"], one["point"]), {})[one["algorithm"]] = one
    rows = []
    for task in sorted({task for task, _ in points}):
        pairs = [both for (of, _), both in points.items() if of == task]
        for metric in ("mean_mm", "vibration_mm", "force_vibration_n"):
            ratios = [float(both["remote-proxy"][metric]) / float(both["base"][metric])
                      for both in pairs if float(both["base"][metric]) > 0]
            case = f"any hand, {task}, {WORDS[metric].split(',')[0]}"
            for metric_word, value in (
                    ("larger than base's by 5 %, % of points",
                     round(100 * sum(ratio > 1.05 for ratio in ratios) / len(ratios), 1)),
                    ("median of the ratios", round(statistics.median(ratios), 3)),
                    ("largest ratio", round(max(ratios), 2))):
                rows.append(data_rows.row(case, "remote-proxy", metric_word, value))
        for algorithm in ("base", "remote-proxy"):
            usable = [both[algorithm]["tier"] != "unusable" for both in pairs]
            rows.append(data_rows.row(f"any hand, {task}", algorithm, "usable, % of points",
                                      round(100 * sum(usable) / len(usable), 1)))
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--programs", type=pathlib.Path, default=ROOT / "build/release/bin")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "build/weak-points")
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    rows = [one for number, case in enumerate(CASES, 1)
            for one in case_rows(options, number, case)]
    rows += map_rows(options)
    manifest = json.loads((options.out / "any-hand/manifest.json").read_text(encoding="utf-8"))
    data_rows.print_file(
        {"about": f"Ten seeds a case, {FIRST_SEED} on; 200 points drawn of any-hand.",
         **data_rows.head(manifest, "scripts/weak_points.py")}, rows=rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
