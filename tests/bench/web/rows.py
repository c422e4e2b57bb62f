# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Rows of a bench, with the keys and by the rules of tests/bench/common/rows.cpp."""


def ratio_of(value, baseline_value):
    """None without a baseline, and where nothing was measured: no ratio tells that."""
    return None if baseline_value is None or value == 0 else baseline_value / value


def is_met(one):
    """Whether a row keeps its target; None without one."""
    if one["target"] is None:
        return None
    is_min = one["direction"] == "min"
    judged = one["ratio"] if one["metric"].endswith("_ratio") else one["value"]
    if judged is None:  # a value of 0 stands above any ratio to it
        return is_min
    return judged >= one["target"] if is_min else judged <= one["target"]


def row(place, metric, value, **judged):
    """`place`: case, subject, baseline. `judged` may have baseline_value, target, direction."""
    one = {"case": None, "subject": None, "baseline": None} | place
    one |= {"metric": metric, "value": value, "baseline_value": judged.get("baseline_value")}
    one["ratio"] = ratio_of(value, one["baseline_value"])
    one |= {"target": judged.get("target"), "direction": judged.get("direction", "max")}
    return one | {"met": is_met(one)}
