# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""What values by seed say of a limit: their mean, the share of usable sessions, the verdict, and
the level of an impairment at which half of the sessions fail."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from statistics import NormalDist
from typing import Dict, NamedTuple, Optional, Sequence, Tuple

from hapnet.student import mean_of
from hapnet.study import quantity
from hapnet.threshold import Threshold, threshold_of

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
        at = f" at {self.parameter} {self.value}" if self.value else ""
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

    def has(self, value: float) -> bool:
        """True if the value is allowed."""
        return self.least <= value <= self.most

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
    seed. `verdict` is Limits.verdict(). `usable` says by seed whether the limits allow the value;
    it is empty if there is no limit."""

    group: Group
    values: Dict[int, float]
    mean: float
    ci_low: Optional[float]
    ci_high: Optional[float]
    verdict: Optional[str]
    usable: Dict[int, bool]

    @property
    def usable_seeds(self) -> Optional[int]:
        """How many of the seeds are usable. None: there is no limit."""
        return sum(self.usable.values()) if self.usable else None

    @property
    def usable_interval(self) -> Tuple[Optional[float], Optional[float]]:
        """The ends of the 95 % interval of the share of usable sessions, from 0 to 1. None: there
        is no limit."""
        if not self.usable:
            return None, None
        return share_interval(sum(self.usable.values()), len(self.usable))


def judged(group: Group, values: Dict[int, float], limits: Limits) -> Verdict:
    """The verdict on the values of a group, of one seed at least."""
    mean, low, high = mean_of(list(values.values()))
    verdict = limits.verdict(low, high)
    usable = {} if verdict is None else {seed: limits.has(one) for seed, one in values.items()}
    return Verdict(group, values, mean, low, high, verdict, usable)


def share_interval(count: int, of: int) -> Tuple[float, float]:
    """The 95 % interval of the share of which `count` of `of` is a sample (Wilson, "Probable
    inference, the law of succession, and statistical inference", Journal of the American
    Statistical Association 22, 1927, 209-212)."""
    z = NormalDist().inv_cdf(0.975)
    middle = (count + 0.5 * z * z) / (of + z * z)
    reach = z / (of + z * z) * math.sqrt(count * (of - count) / of + 0.25 * z * z)
    return (0.0 if count == 0 else middle - reach), (1.0 if count == of else middle + reach)


def thresholds(verdicts: Sequence[Verdict]) -> Dict[Group, Threshold]:
    """The levels at which half of the sessions fail, in ms or percent, for each algorithm and task
    (the `value` of these groups is empty). Needs limits, and a single axis of two levels or more
    over a delay, a jitter or a loss of [both], [up], [down] or a link. Else the result is empty,
    and so it is if a value of the axis is a law instead of a time or a share."""
    failed: Dict[Group, Dict[float, Tuple[bool, ...]]] = {}
    for one in verdicts:
        level = _level_of(one.group)
        if level is None or not one.usable:
            return {}
        outcomes = tuple(not one.usable[seed] for seed in sorted(one.usable))
        failed.setdefault(one.group._replace(value=""), {})[level] = outcomes
    return {group: threshold_of(*zip(*sorted(by_level.items())))
            for group, by_level in failed.items() if len(by_level) > 1}


def unit_of(parameter: str) -> str:
    """The unit of the levels of an impairment."""
    return "percent" if parameter.endswith("loss") else "ms"


def _level_of(group: Group) -> Optional[float]:
    """The level of the impairment that the axis varies. None: it varies something else."""
    if re.fullmatch(r"(both|all|up|down|link\..+)\.(delay|jitter|loss)", group.parameter) is None:
        return None
    try:
        return quantity.parse(group.value, "ms" if unit_of(group.parameter) == "ms" else "%")
    except ValueError:
        return None
