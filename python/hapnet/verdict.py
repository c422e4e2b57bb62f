# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""What values by seed say of a limit: their mean, its interval, and the verdict."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass
from typing import Dict, NamedTuple, Optional, Sequence, Tuple

RESAMPLES = 10_000
TAIL = RESAMPLES // 40  # 2.5 %
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
    """What is allowed, the limits themselves included, in the unit of the metric. None: no limit.
    Raises CannotJudge for one that is not finite, and where nothing lies between them."""

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
        """Of the interval from `low` to `high`. GOOD: all of it is allowed. NOT_GOOD: all of it is
        beyond one limit. Else, or without an interval, UNDECIDED. None: there is no limit."""
        if self.at_most is None and self.at_least is None:
            return None
        if low is None or high is None:
            return UNDECIDED
        if self.least <= low and high <= self.most:
            return GOOD
        return NOT_GOOD if high < self.least or low > self.most else UNDECIDED


@dataclass(frozen=True)
class Verdict:
    """What a metric says of a group, in its unit. `values` are by seed, and `ci_low` and `ci_high`
    are interval() of them. `verdict` is Limits.verdict()."""

    group: Group
    values: Dict[int, float]
    mean: float
    ci_low: Optional[float]
    ci_high: Optional[float]
    verdict: Optional[str]


def mean(values: Sequence[float]) -> float:
    """Of at least one value; of equal ones that value, whatever a sum would round."""
    return min(max(math.fsum(values) / len(values), min(values)), max(values))


def interval(values: Sequence[float]) -> Tuple[Optional[float], Optional[float]]:
    """The 95 % interval of the mean by the percentiles of the bootstrap (Efron and Tibshirani, "An
    Introduction to the Bootstrap", 1993, chapter 13): the 250th and the 9750th of the ordered means
    of 10 000 resamples, drawn with one seed. Fewer than two values have none. Of ten values it is
    about a fifth too narrow (Hesterberg, The American Statistician 69, 2015)."""
    if len(values) < 2:
        return None, None
    draw = random.Random(1)
    means = sorted(mean(draw.choices(values, k=len(values))) for _ in range(RESAMPLES))
    return means[TAIL - 1], means[RESAMPLES - TAIL - 1]


def judged(group: Group, values: Dict[int, float], limits: Limits) -> Verdict:
    """The verdict on the values of a group, of one seed at least."""
    numbers = list(values.values())
    low, high = interval(numbers)
    return Verdict(group, values, mean(numbers), low, high, limits.verdict(low, high))
