#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""What recorded hands change: verdicts, claims and rankings with four kinds of hands.

    scripts/recorded_hands.py PEOPLE [--programs DIR] [--out DIR] [--quick] >FILE

PEOPLE is a folder that `hapnet-lab import hands` has written, with at least two trials of a
subject. Simulated hands are fitted to each second trial. Then the task T3 is played with the
nominal hand, with the trials that no fit saw, with the fitted hands, and with the trials that the
fit saw. The last show how much people's own results differ. The file is one of
scripts/result_tables.py. Results stay in --out (default build/recorded-hands), so that a second run
plays only what is missing. Twelve trials of 5 s take seven minutes on two processors; --quick, with
one delay, two networks and four fitted trials, twenty seconds.
"""
import argparse
import csv
import datetime
import itertools
import json
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
ALGORITHMS = ("base", "sep", "dead-reckoning", "remote-proxy")
DELAYS_MS = (50, 100, 160, 200, 300)
FITTED_TRIALS, QUICK_TRIALS, NOMINAL_SEEDS = 30, 4, 20
# Claims of docs/results/beat.md that T3 can judge: delay, metric, factor, target.
CLAIMS = ((160, "mean distance, mm", "mean_mm", 1, 2.5),
          (200, "mean distance, mm", "mean_mm", 1, 3.5),
          (300, "mean distance, mm", "mean_mm", 1, 8.0),
          (100, "contact lost added, %", "contact_lost", 100, 8.0),
          (200, "contact lost added, %", "contact_lost", 100, 12.0))


def lab(options, *words):
    subprocess.run([options.programs / "hapnet-lab", *map(str, words)], check=True,
                   stdout=sys.stderr)


def play(options, experiment, kind, *settings):
    """Plays an experiment with one kind of hands; the rows of its first table of that name."""
    if experiment == "any-network" and options.quick:
        settings = (*settings, "latin_hypercube.points=2")
    if kind == "nominal":
        hands = ["seeds=1" if experiment == "any-network" else f"seeds={NOMINAL_SEEDS}"]
    else:
        hands = [f"hands={options.folders[kind]}/", "duration=script", "seeds=1"]
    words = [f"algorithms={json.dumps(ALGORITHMS)}", 'tasks=["T3"]', *hands, *settings]
    out = options.out / "-".join([experiment, kind.replace(" ", "-"), *settings]).replace("=", "-")
    lab(options, "run", experiment, "--out", out,
        *(word for setting in words for word in ("--set", setting)))
    name = "qos_by_point.csv" if experiment == "any-network" else "tasks.csv"
    with open(out / name, newline="", encoding="utf-8") as file:
        return [one for one in csv.DictReader(file) if one["task"] == "T3"]


def row(case, metric, kind, value, target=None):
    value = round(value, 4)
    return {"case": case, "subject": kind, "baseline": None, "metric": metric, "value": value,
            "baseline_value": None, "ratio": None, "target": target, "direction": "max",
            "met": None if target is None else value <= target}


def tau(means, others):
    """Kendall's tau of two orders of the algorithms without ties."""
    pairs = list(itertools.combinations(ALGORITHMS, 2))
    same = sum((means[a] < means[b]) == (others[a] < others[b]) for a, b in pairs)
    return 2 * same / len(pairs) - 1


def delay_rows(played, delay_ms):
    rows = []
    means = {kind: {one["algorithm"]: float(one["mean_mm"]) for one in table}
             for kind, table in played.items()}
    for algorithm, (kind, table) in itertools.product(ALGORITHMS, played.items()):
        one, = (one for one in table if one["algorithm"] == algorithm)
        case = f"{delay_ms} ms, {algorithm}"
        rows.append(row(case, "mean distance, mm", kind, float(one["mean_mm"])))
        usable = float(one["usable_seeds"]) / float(one["seeds"])
        rows.append(row(case, "usable, %", kind, 100 * usable))
        for when, words, column, factor, target in CLAIMS:
            if (when, algorithm) == (delay_ms, "remote-proxy"):
                rows.append(row(f"claim, {delay_ms} ms", words, kind, factor * float(one[column]),
                                target))
    for kind, of_kind in means.items():
        rows.append(row(f"{delay_ms} ms, order", "Kendall's tau with the unseen trials", kind,
                        tau(of_kind, means["unseen trials"])))
    return rows


def network_rows(kind, table):
    points = {}
    for one in table:
        points.setdefault(one["point"], {})[one["algorithm"]] = one
    rows = []
    for algorithm in ALGORITHMS:
        case = f"any network, {algorithm}"
        usable = [point[algorithm]["tier"] != "unusable" for point in points.values()]
        rows.append(row(case, "usable, % of points", kind, 100 * sum(usable) / len(usable)))
        if algorithm == "base":
            continue
        nearer = [float(point[algorithm]["mean_mm"]) < float(point["base"]["mean_mm"])
                  for point in points.values()]
        rows.append(row(case, "nearer than base, % of points", kind,
                        100 * sum(nearer) / len(nearer)))
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("people", type=pathlib.Path)
    parser.add_argument("--programs", type=pathlib.Path, default=ROOT / "build/release/bin")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "build/recorded-hands")
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    fitted = (options.out / "fitted").resolve()
    trials = QUICK_TRIALS if options.quick else FITTED_TRIALS
    lab(options, "fit", "hands", options.people, "--trials", trials, "--out", fitted)
    options.folders = {"unseen trials": fitted / "unseen", "fitted hands": fitted / "simulated",
                       "seen trials": fitted / "seen"}
    kinds = ("nominal", *options.folders)
    rows = []
    for delay_ms in (100,) if options.quick else DELAYS_MS:
        rows += delay_rows({kind: play(options, "table1", kind, f"both.delay={delay_ms}ms")
                            for kind in kinds}, delay_ms)
    for kind in kinds:
        rows += network_rows(kind, play(options, "any-network", kind))
    fit = json.loads((fitted / "fit.json").read_text(encoding="utf-8"))
    inside = sum(one["unseen_min"] <= one["simulated"] <= one["unseen_max"]
                 for one in fit["figures"])
    about = (f"{fit['seen_trials']} seen and {fit['unseen_trials']} unseen trials of "
             f"{len(fit['subjects'])} subjects, {fit['simulated_trials']} fitted ones; "
             f"{inside} of {len(fit['figures'])} figures of the fitted motion lie among those of "
             f"the unseen trials.")
    manifest, = list(options.out.glob("any-network-nominal*/manifest.json"))
    commit = json.loads(manifest.read_text(encoding="utf-8"))["commit"]
    print(json.dumps({"about": about, "commit": commit,
                      "date": datetime.date.today().isoformat(),
                      "machine": f"{os.cpu_count()} processors",
                      "command": "scripts/recorded_hands.py PEOPLE"})[:-1] + ', "rows": [')
    print(",\n".join("  " + json.dumps(one) for one in rows))
    print("]}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
