# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""What a design would play for a participant, and how long that takes."""

from __future__ import annotations

from dataclasses import replace
from statistics import median
from typing import Any

from hapnet.study import quantity
from hapnet.study.answers import is_noticed
from hapnet.study.design import Design, Observer
from hapnet.study.observer import Simulated
from hapnet.study.plan import Plan, Trial

START_S = 2.0  # time until a session's common start, with the check of its records
ANSWER_S = 3.0
MEGABYTES_PER_S = 0.8  # the records of both peers
SIMULATED = 41  # observers; their median is shown


def played(design: Design, participant: int) -> list[Trial]:
    """The trials of a participant whose answers are those of the simulated observer."""
    plan, who = Plan(design, participant), Simulated(design, participant)
    trials = []
    while (trial := plan.next()) is not None:
        trials.append(trial)
        plan.take(is_noticed(design, trial, who.ask(trial)))
    return trials


def of(design: Design, participant: int) -> dict[str, Any]:
    """What check --json prints."""
    assumed = design.observer is None
    if assumed:  # the middle of the range, for the length of a staircase
        middle = 0.5 * (design.reference + design.highest)
        design = replace(design, observer=Observer(middle, 4.0, 0.0))
    trials = played(design, participant)
    numbers = [len(trials)]
    if design.staircase:
        numbers = sorted(len(played(design, one)) for one in range(1, SIMULATED + 1))
    sessions = 2 if design.two_intervals else 1
    each = sessions * (design.duration_s + START_S) + ANSWER_S
    breaks = (design.blocks - 1) * design.break_s
    result: dict[str, Any] = {
        "title": design.title, "factor": design.factor, "participant": participant,
        "trials": round(median(numbers)), "trials_min": numbers[0], "trials_max": numbers[-1],
        "sessions_per_trial": sessions,
        "duration_s": round(median(numbers) * each + breaks, 1),
        "duration_max_s": round(numbers[-1] * each + breaks, 1),
        "records_mb": round(median(numbers) * sessions * design.duration_s * MEGABYTES_PER_S),
        "threshold_assumed": design.level_text(design.observer.threshold) if (  # type: ignore
            assumed and design.staircase) else None,
        "order": [{"trial": one.number, "block": one.block,
                   "level": design.level_text(one.level), "is_catch": one.is_catch,
                   "worse": one.worse}
                  for one in trials] if design.levels else None,
    }
    return result


def told(design: Design, result: dict[str, Any]) -> list[str]:
    """The lines for people."""
    lines = [f"{result['title']}: {result['factor']}, task {design.task}, algorithm "
             f"{design.algorithm}, {design.duration_s:g} s each"]
    asked = f"asked: {design.question}" + (
        " (1 or 2)" if design.two_intervals else f" (yes or no; {design.noticed}: it was noticed)")
    lines.append(asked)
    if design.staircase:
        rule = design.staircase
        lines.append(f"{design.repetitions} staircases from {design.level_text(rule.start)} in "
                     f"steps of {design.level_text(rule.step)}, {rule.down} down, {rule.up} up, "
                     "until "
                     f"{rule.reversals} reversals; {result['trials_min']} to "
                     f"{result['trials_max']} trials by simulated observers"
                     + (f" with a threshold of {result['threshold_assumed']}"
                        if result["threshold_assumed"] else ""))
    else:
        levels = ", ".join(design.level_text(one) for one in design.levels)
        lines.append(f"{len(design.levels)} levels, {design.repetitions} times each: {levels}")
        for block in range(1, design.blocks + 1):
            order = " ".join(one["level"] + ("*" if one["is_catch"] else "")
                             for one in result["order"] if one["block"] == block)
            lines.append(f"block {block} of participant {result['participant']}: {order}")
    if design.catch_trials:
        lines.append(f"{design.catch_trials} catch trials in each block"
                     + ("" if design.staircase else ", marked *"))
    lines.append(f"{result['trials']} trials of {result['sessions_per_trial']} "
                 f"session{'s' if result['sessions_per_trial'] > 1 else ''}: about "
                 f"{quantity.span(result['duration_s'])} and {result['records_mb']} MB of records "
                 "for each participant")
    return lines
