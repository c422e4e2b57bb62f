# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""What values by seed say of a limit: their mean, its interval, and the verdict."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Dict, NamedTuple, Optional

from hapnet.student import mean_of

GOOD, NOT_GOOD, UNDECIDED = "good", "not good", "undecided"


class CannotJudge(ValueError):
    """The text says where, why, and what helps."""


class Group(NamedTuple):
    """What the sessions of all seeds have in common. `parameter` and `value` name the point of the
    axes ("both.delay", "40ms"; of several axes joined by "; "), and are empty without an axis."""

    parameter: str
    value: str
    algorithm: str
    task: str

    def __str__(self) -> str:
        at = f" at {self.parameter} {self.value}" if self.parameter else ""
        return f"{self.algorithm}-{self.task}{at}"


@dataclass(frozen=True)
class Limits:
    """The allowed range, limits included, in the unit of the metric. None: no limit. Raises
    CannotJudge if a limit is not finite, or if the lower limit is above the upper one."""

    at_most: Optional[float] = None
    at_least: Optional[float] = None

    def __post_init__(self) -> None:
        if not all(one is None or math.isfinite(one) for one in (self.at_most, self.at_least)):
            raise CannotJudge("a limit is not a finite number: leave it out where there is none")
        if None not in (self.at_most, self.at_least) and self.least > self.most:
            raise CannotJudge(f"the limits at most {self.at_most} and at least {self.at_least} "
                              "leave nothing between them: exchange them")

    @property
    def least(self) -> float:
        return -math.inf if self.at_least is None else self.at_least

    @property
    def most(self) -> float:
        return math.inf if self.at_most is None else self.at_most

    def __str__(self) -> str:
        both = ((">=", self.at_least), ("<=", self.at_most))
        return " and ".join(f"{sign} {one}" for sign, one in both if one is not None)

    def verdict(self, low: Optional[float], high: Optional[float]) -> Optional[str]:
        """The verdict on the interval from `low` to `high`. GOOD: all of it is allowed. NOT_GOOD:
        all of it is beyond one limit. Else, or without an interval, UNDECIDED. None: there is no
        limit."""
        if self.at_most is None and self.at_least is None:
            return None
        if low is None or high is None:
            return UNDECIDED
        if self.least <= low and high <= self.most:
            return GOOD
        return NOT_GOOD if high < self.least or low > self.most else UNDECIDED


@dataclass(frozen=True)
class Verdict:
    """What a metric says of a group, in its unit. `values` are by seed. `ci_low` and `ci_high`
    are the ends of the 95 % interval of their mean by Student's distribution; None for a single
    seed. `verdict` is Limits.verdict()."""

    group: Group
    values: Dict[int, float]
    mean: float
    ci_low: Optional[float]
    ci_high: Optional[float]
    verdict: Optional[str]


def judged(group: Group, values: Dict[int, float], limits: Limits) -> Verdict:
    """The verdict on the values of a group, of one seed at least."""
    mean, low, high = mean_of(list(values.values()))
    return Verdict(group, values, mean, low, high, limits.verdict(low, high))
