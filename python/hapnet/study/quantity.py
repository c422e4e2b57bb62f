# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Times and shares with their units, as profiles write them. Inside, a time is in milliseconds and
a share in percent."""

from __future__ import annotations

import re

UNITS = {
    "ms": {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3, "min": 6e4, "h": 3.6e6},
    "%": {"%": 1.0},
}
KINDS = {"ms": "time", "%": "share"}
EXAMPLES = {"ms": '"40ms"', "%": '"5%"'}


def parse(value: object, unit: str) -> float:
    """The number of a time ("ms") or a share ("%"). Raises ValueError with reason and cure."""
    example = EXAMPLES[unit]
    if not isinstance(value, str):
        raise ValueError(f"{value!r} is no {KINDS[unit]}: write it as a text, such as {example}")
    found = re.fullmatch(r"(\d{1,12}(?:\.\d{1,9})?)(\D{0,8})", value)
    if found is None:
        raise ValueError(f"{value!r} is no {KINDS[unit]}: write a number and a unit, as {example}")
    number, word = found.groups()
    if word not in UNITS[unit]:
        units = ", ".join(UNITS[unit])
        what = f"has the unknown unit {word!r}" if word else "has no unit"
        raise ValueError(f"{value!r} {what}: write one of {units}, as {example}")
    result = float(number) * UNITS[unit][word]
    if unit == "%" and result > 100.0:
        raise ValueError(f"{value!r} is more than 100%: write a share of at most 100%")
    return result


def text(number: float, unit: str) -> str:
    """The quantity as a profile has it: "40ms", "2.5%"."""
    return f"{round(number, 6):.6f}".rstrip("0").rstrip(".") + unit


def span(seconds: float) -> str:
    """About how long something takes, for people: "35 s", "12 min", "1 h 5 min"."""
    if seconds < 120.0:
        return f"{seconds:.0f} s"
    minutes = round(seconds / 60.0)
    return f"{minutes} min" if minutes < 60 else f"{minutes // 60} h {minutes % 60} min"
