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
one delay, two networks and four fitted trials, half a minute.
"""
import argparse
import csv
import itertools
import json
import math
import pathlib
import statistics
import subprocess
import sys

sys.dont_write_bytecode = True
import data_rows  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
ALGORITHMS = ("base", "sep", "dead-reckoning", "remote-proxy")
DELAYS_MS = (50, 100, 160, 200, 300)
FITTED_TRIALS, QUICK_TRIALS, NOMINAL_SEEDS = 30, 4, 20
# Claims of docs/results/beat.md that T3 can judge, by delay: targets of the mean distance, and of
# the contact lost in nine of ten sessions.
MEAN_CLAIMS = {160: 2.5, 200: 3.5, 300: 8.0}
LOST_CLAIMS = {100: 8.0, 200: 12.0}


def lab(options, *words):
    done = subprocess.run([options.programs / "hapnet-lab", *map(str, words)], check=False,
                          stdout=sys.stderr)
    if done.returncode != 0:
        sys.exit(done.returncode)  # it has said why


def play(options, experiment, kind, *settings):
    """Plays an experiment with one kind of hands; the rows of its sessions of T3."""
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
    options.manifest = json.loads((out / "manifest.json").read_text(encoding="utf-8"))
    name = "sessions_by_point.csv" if experiment == "any-network" else "sessions.csv"
    with open(out / name, newline="", encoding="utf-8") as file:
        return [one for one in csv.DictReader(file) if one["task"] == "T3"]


def mean_between(sessions):
    """The mean distance: each subject counts once."""
    subjects = {}
    for one in sessions:
        subjects.setdefault(one.get("subject"), []).append(float(one["mean_mm"]))
    return statistics.fmean(statistics.fmean(values) for values in subjects.values())


def usable(sessions):
    return 100 * statistics.fmean(one["tier"] != "unusable" for one in sessions)


def nine_of_ten(values):
    """The value that nine of ten do not exceed, by the nearest rank."""
    return sorted(values)[math.ceil(0.9 * len(values)) - 1]


def row(case, metric, kind, value, target=None):
    return data_rows.row(case, kind, metric, round(value, 4), target)


def tau(means, others):
    """Kendall's tau of two orders of the algorithms without ties."""
    pairs = list(itertools.combinations(ALGORITHMS, 2))
    same = sum((means[a] < means[b]) == (others[a] < others[b]) for a, b in pairs)
    return 2 * same / len(pairs) - 1


def delay_rows(played, delay_ms):
    rows = []
    means = {kind: {} for kind in played}
    for algorithm, (kind, table) in itertools.product(ALGORITHMS, played.items()):
        sessions = [one for one in table if one["algorithm"] == algorithm]
        means[kind][algorithm] = mean = mean_between(sessions)
        case = f"{delay_ms} ms, {algorithm}"
        rows.append(row(case, "mean distance, mm", kind, mean))
        rows.append(row(case, "usable, %", kind, usable(sessions)))
        if algorithm != "remote-proxy":
            continue
        if delay_ms in MEAN_CLAIMS:
            rows.append(row(f"claim, {delay_ms} ms", "mean distance, mm", kind, mean,
                            MEAN_CLAIMS[delay_ms]))
        if delay_ms in LOST_CLAIMS:
            lost = nine_of_ten([100 * float(one["contact_lost"]) for one in sessions])
            rows.append(row(f"claim, {delay_ms} ms", "contact lost added, %, nine of ten", kind,
                            lost, LOST_CLAIMS[delay_ms]))
    for kind, of_kind in means.items():
        rows.append(row(f"{delay_ms} ms, order", "Kendall's tau with the unseen trials", kind,
                        tau(of_kind, means["unseen trials"])))
    return rows


def network_rows(kind, table):
    points = {}
    for one in table:
        points.setdefault(one["point"], {}).setdefault(one["algorithm"], []).append(one)
    rows = []
    for algorithm in ALGORITHMS:
        case = f"any network, {algorithm}"
        sessions = [one for point in points.values() for one in point[algorithm]]
        rows.append(row(case, "usable, % of sessions", kind, usable(sessions)))
        if algorithm == "base":
            continue
        nearer = [mean_between(point[algorithm]) < mean_between(point["base"])
                  for point in points.values()]
        rows.append(row(case, "nearer than base, % of networks", kind,
                        100 * statistics.fmean(nearer)))
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
    data_rows.print_file({"about": about,
                          **data_rows.head(options.manifest, "scripts/recorded_hands.py PEOPLE")},
                         rows=rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
