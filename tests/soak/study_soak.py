#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Do the intervals of hapnet-study hold the threshold of simulated observers as often as they say?

Usage: study_soak.py [OBSERVERS [FIRST]]

Plays four designs with 4000 observers each, by the same code as hapnet-study. Prints a
row for each design; exits 1 when a coverage is not between 93.5 and 96.5 %, or, with fewer than
4000 observers, when it cannot be by chance (one in a thousand)."""

import math
import multiprocessing
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
from hapnet.study.analyse import counts_of, kind_of  # noqa: E402
from hapnet.study.answers import Answer, is_noticed  # noqa: E402
from hapnet.study.design import read_design  # noqa: E402
from hapnet.study.interval import interval_of  # noqa: E402
from hapnet.study.observer import Simulated, curve_of  # noqa: E402
from hapnet.study.plan import Plan  # noqa: E402
from hapnet.study.psychometric import fitted  # noqa: E402

LEAST, MOST, WHOLE = 0.935, 0.965, 4000
COMMON = 'factor = "both.delay"\nobserver = { threshold = "80ms", slope = 4 }\n'
STAIRCASE = ('staircase = { start = "160ms", step = "20ms", down = 2, up = 1, reversals = 8 }\n'
             "repetitions = 2\n")
DESIGNS = {
    "levels, yes or no": 'levels = ["0ms", "40ms", "80ms", "120ms", "160ms"]\nquestion = "?"\n',
    "levels, two intervals": 'levels = ["20ms", "60ms", "100ms", "140ms", "180ms"]\n'
                             "repetitions = 20\ntwo_intervals = true\n",
    "staircase, yes or no": STAIRCASE + 'question = "?"\n',
    "staircase, two intervals": STAIRCASE + "two_intervals = true\n",
}


def design_of(name):
    with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
        file.write(COMMON + DESIGNS[name])
        file.flush()
        return read_design(file.name)


def counts_by(design, participant):
    """The answers of one simulated observer, as counts, and how many they are."""
    plan, who, answers = Plan(design, participant), Simulated(design, participant), []
    while (trial := plan.next()) is not None:
        answer = who.ask(trial)
        answers.append(Answer(trial, answer, is_noticed(design, trial, answer)))
        plan.take(answers[-1].noticed)
    return tuple(counts_of(answers)), len(answers)


def held_by(design, counts):
    """Below the interval of these counts, in it or above; and the threshold that is found."""
    truth = curve_of(design).location
    curve = fitted(counts, kind_of(design))
    low, high = interval_of(design, counts, curve)
    side = -1 if low is not None and truth < low else 1 if high is not None and truth > high else 0
    return side, curve.level_of(kind_of(design).at)


def work(job):
    name, counts = job
    return held_by(design_of(name), counts)


def chance_below(hits, of, share):
    """The probability of that number of hits, or less."""
    logs = [math.lgamma(of + 1) - math.lgamma(k + 1) - math.lgamma(of - k + 1)
            + k * math.log(share) + (of - k) * math.log1p(-share) for k in range(hits + 1)]
    return math.fsum(map(math.exp, logs))


def is_kept(hits, of):
    """Is the coverage in its band, as far as this number of observers can tell?"""
    if of >= WHOLE:
        return LEAST <= hits / of <= MOST
    return chance_below(hits, of, LEAST) > 1e-3 and (
        chance_below(of - hits, of, 1.0 - MOST) > 1e-3)


def play(name, observers, first, pool):
    design = design_of(name)
    played = [counts_by(design, first + i) for i in range(observers)]
    different = list(dict.fromkeys(counts for counts, _ in played if len(counts) > 1))
    found = dict(zip(different, pool.map(work, [(name, one) for one in different], 8)))
    sides = [found[counts] for counts, _ in played if counts in found]
    hits = sum(side == 0 for side, _ in sides)
    thresholds = sorted(threshold for _, threshold in sides)
    print(f"  {name:26} {hits / len(sides):7.2%} of {len(sides)} held, "
          f"{sum(side < 0 for side, _ in sides) / len(sides):.2%} below, "
          f"{sum(side > 0 for side, _ in sides) / len(sides):.2%} above; median threshold "
          f"{thresholds[len(thresholds) // 2]:.1f} ms; "
          f"{sum(trials for _, trials in played) / observers:.0f} trials", flush=True)
    return is_kept(hits, len(sides))


def main():
    observers = int(sys.argv[1]) if len(sys.argv) > 1 else WHOLE
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    with multiprocessing.Pool() as pool:
        kept = [play(name, observers, first, pool) for name in DESIGNS]
    return 0 if all(kept) else 1


if __name__ == "__main__":
    sys.exit(main())
