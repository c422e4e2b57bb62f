# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""From answers to thresholds: of each participant, and over all of them."""

from __future__ import annotations

import csv
import io
import json
import os
import re
from typing import Any, Optional, Sequence

from hapnet.results import write_whole
from hapnet.student import mean_of
from hapnet.study.answers import NAME, Answer, AnswersError, SCHEMA, folder_of, read_lines, replayed
from hapnet.study.design import Design
from hapnet.study.figure import svg
from hapnet.study.interval import interval_of
from hapnet.study.plan import Plan
from hapnet.study.psychometric import TWO_INTERVALS, YES_NO, Count, Kind, fitted

THRESHOLDS = ("participant", "threshold", "bound", "ci_low", "ci_high", "unit", "at", "trials",
              "catch_trials", "catch_noticed", "not_valid", "is_complete", "observer")
LEVELS = ("participant", "level", "unit", "noticed", "of")


def kind_of(design: Design) -> Kind:
    return TWO_INTERVALS if design.two_intervals else YES_NO


def counts_of(answers: Sequence[Answer]) -> list[Count]:
    """How many of how many were noticed at each level, without catch trials."""
    found: dict[float, list[int]] = {}
    for one in answers:
        if not one.trial.is_catch:
            count = found.setdefault(one.trial.level, [0, 0])
            count[0] += one.noticed
            count[1] += 1
    return [Count(level, *found[level]) for level in sorted(found)]


def participants_in(out: str) -> list[int]:
    """The numbers of those who have answers there."""
    names = os.listdir(out)
    numbers = [int(found[1]) for name in names
               if (found := re.fullmatch(r"participant-(\d{4})", name))]
    return sorted(n for n in numbers if os.path.exists(os.path.join(folder_of(out, n), NAME)))


def read_answers(design: Design, out: str, participant: int) -> tuple[list[Answer], bool, str]:
    """The answers of a participant, whether these are all, and who gave them."""
    path = os.path.join(folder_of(out, participant), NAME)
    file = os.open(path, os.O_RDONLY)
    try:
        lines, _ = read_lines(file, path)
    finally:
        os.close(file)
    if not lines:
        return [], False, "person"
    for key, value in (("schema", SCHEMA), ("design", design.digest())):
        if lines[0].get(key) != value:
            raise AnswersError(f"{path}:1: these answers belong to another design ({key} "
                               f"{lines[0].get(key)!r}): analyse them with the design of the "
                               "trials, or name another --out")
    plan = Plan(design, participant)
    answers = replayed(design, plan, lines[1:], path)
    return answers, plan.next() is None, str(lines[0].get("observer", "person"))


def row_of(design: Design, participant: int, answers: Sequence[Answer], is_complete: bool,
           observer: str) -> dict[str, Any]:
    """What a participant's answers tell."""
    counts, kind = counts_of(answers), kind_of(design)
    catches = [one for one in answers if one.trial.is_catch]
    row: dict[str, Any] = {
        "participant": participant, "threshold": None, "bound": None, "ci_low": None,
        "ci_high": None, "curve": None,
        "trials": len(answers) - len(catches),
        "catch_trials": len(catches),
        "catch_noticed": None if design.two_intervals else sum(one.noticed for one in catches),
        "not_valid": sum(not one.is_valid for one in answers),
        "is_complete": is_complete, "observer": observer,
        "levels": [count._asdict() for count in counts],
    }
    if len(counts) < 2:
        return row
    curve = fitted(counts, kind)
    row["curve"] = vars(curve)
    at = curve.level_of(kind.at)
    row["bound"] = "<" if at < design.reference else ">" if at > design.highest else "="
    row["threshold"] = min(max(at, design.reference), design.highest)
    low, high = interval_of(design, counts, curve)
    row["ci_low"], row["ci_high"] = low, high
    return row


def falls(rows: Sequence[dict[str, Any]]) -> bool:
    """Are higher levels noticed less often, over all participants?"""
    counts = [count for row in rows for count in row["levels"]]
    of = sum(count["of"] for count in counts)
    if not of:
        return False
    mean = sum(count["of"] * count["level"] for count in counts) / of
    share = sum(count["noticed"] for count in counts) / of
    slant = sum((count["level"] - mean) * (count["noticed"] - share * count["of"])
                for count in counts)
    spread = sum(count["of"] * (count["level"] - mean) ** 2 for count in counts)
    noise = (spread * share * (1.0 - share)) ** 0.5
    return noise > 0.0 and slant < -2.0 * noise


def overall(rows: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """The mean of the participants' thresholds, with its 95 % interval."""
    known = [row for row in rows if row["threshold"] is not None]
    open_ones = [row["participant"] for row in known if row["bound"] != "="]
    result: dict[str, Any] = {"participants": len(known), "threshold": None, "ci_low": None,
                              "ci_high": None, "beyond_the_levels": open_ones}
    if known and not open_ones:
        mean, low, high = mean_of([row["threshold"] for row in known])
        result.update(threshold=mean, ci_low=low, ci_high=high)
    return result


def analysed(design: Design, out: str) -> dict[str, Any]:
    """What the answers in a folder tell, as --json prints it. Raises AnswersError and OSError."""
    rows = [row_of(design, one, *read_answers(design, out, one)) for one in participants_in(out)]
    if not rows:
        raise AnswersError(f"{out}: there is no answer yet: start hapnet-study run first")
    return {
        "title": design.title, "factor": design.factor, "unit": design.unit,
        "at": kind_of(design).at, "two_intervals": design.two_intervals,
        "falls": falls(rows), "participants": rows, "all": overall(rows),
    }


def write(design: Design, out: str, result: dict[str, Any]) -> list[str]:
    """Writes thresholds.csv, levels.csv, analysis.json and study.svg; returns their paths."""
    rows = result["participants"]
    common = {"unit": design.unit, "at": result["at"]}
    everyone = {"participant": "all", "bound": "=", "trials": sum(row["trials"] for row in rows),
                **{key: result["all"][key] for key in ("threshold", "ci_low", "ci_high")}}
    levels = [{"participant": row["participant"], "unit": design.unit, **count}
              for row in rows for count in row["levels"]]
    share = "share of right answers" if design.two_intervals else "share noticed"
    texts = {
        "thresholds.csv": table(THRESHOLDS, [{**row, **common} for row in [*rows, everyone]]),
        "levels.csv": table(LEVELS, levels),
        "analysis.json": json.dumps(result, indent=2) + "\n",
        "study.svg": svg(result, (design.lowest, design.highest), share),
    }
    for name, text in texts.items():
        write_whole(os.path.join(out, name), text)
    return [os.path.join(out, name) for name in texts]


def table(columns: Sequence[str], rows: Sequence[dict[str, Any]]) -> str:
    """The rows as CSV; what a row does not have is empty."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows([_cell(row.get(column)) for column in columns] for row in rows)
    return text.getvalue()


def _cell(value: Any) -> str:
    if value is None:
        return ""
    if isinstance(value, bool):
        return "true" if value else "false"
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def told(design: Design, result: dict[str, Any]) -> list[str]:
    """The lines for people."""
    share = "3 of 4 answers are right" if design.two_intervals else "half of the trials are noticed"
    lines = [f"{design.title}: {design.factor} at which {share}, with 95 % intervals"]
    for row in result["participants"]:
        ends = _ends(design, row)
        more = "" if row["is_complete"] else ", not complete"
        more += f", {row['not_valid']} not valid" if row["not_valid"] else ""
        more += f", {row['catch_noticed']} of {row['catch_trials']} catch trials noticed" if (
            row["catch_trials"] and row["catch_noticed"] is not None) else ""
        who = f"participant {row['participant']:>4}"
        lines.append(f"  {who}  {ends}  ({row['trials']} trials{more})")
    everyone = result["all"]
    if everyone["beyond_the_levels"]:
        who = ", ".join(str(one) for one in everyone["beyond_the_levels"])
        lines.append(f"  no mean: the threshold of {who} lies beyond the levels; play more levels")
    else:
        lines.append(f"  mean of {everyone['participants']:>8}  {_ends(design, everyone)}")
    if result["falls"]:
        other = "no" if design.noticed == "yes" else "yes"
        lines.append("  warning: higher levels are noticed less often: does the question ask for "
                     f'the opposite? Then write noticed = "{other}"')
    return lines


def _ends(design: Design, row: dict[str, Any]) -> str:
    def words(level: Optional[float]) -> str:
        return "?" if level is None else f"{level:.4g}{design.unit}"

    if row["threshold"] is None:
        return "unknown"
    bound = row.get("bound", "=")
    return (f"{'' if bound == '=' else bound + ' '}{words(row['threshold'])}"
            f" [{words(row['ci_low'])}, {words(row['ci_high'])}]")
