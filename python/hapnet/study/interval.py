# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""The 95 % interval of a participant's threshold: the middle of its posterior distribution (Kuss,
Jaekel and Wichmann, "Bayesian inference for psychometric functions", Journal of Vision 5, 2005,
478-492), with the prior of the fit, over all thresholds from the reference to twice the range and
all scales, for the core and the lapses of the fit.

A staircase chooses its levels by the answers alone, so that its likelihood, and with it the
posterior, is the same function of the counts as for levels that were fixed before.

The lab draws seeds again instead (lab/metrics/psychometric.hpp): one seed gives an answer at every
level. Trials of a participant are too few for that, and those of a staircase depend on each
other."""

from __future__ import annotations

import math
from typing import Optional, Sequence

from hapnet.study.design import Design
from hapnet.study.psychometric import (
    LEAST, TWO_INTERVALS, YES_NO, Count, Curve, core_at, fitted, rise_of, scaled,
)

MASS = 0.95  # of the posterior; tests/soak/study_soak.py measures how many observers it holds
LOG_SCALES = [i / 4 for i in range(-14, 15)]  # in standard deviations of the prior
COARSE, FINE = 48, 64  # thresholds
NEGLIGIBLE = 1e-5


def interval_of(design: Design, counts: Sequence[Count],
                curve: Optional[Curve] = None) -> tuple[Optional[float], Optional[float]]:
    """The ends of the interval; None where one lies beyond the levels. `curve`: the fit."""
    kind = TWO_INTERVALS if design.two_intervals else YES_NO
    curve = curve or fitted(counts, kind)
    posterior = _Marginal(counts, curve, kind.at)
    top = design.highest + (design.highest - design.reference)
    places, weights = posterior.over(design.reference, top, COARSE)
    limit = NEGLIGIBLE * max(weights)
    held = [i for i, weight in enumerate(weights) if weight > limit]
    low, high = places[max(held[0] - 1, 0)], places[min(held[-1] + 1, len(places) - 1)]
    places, weights = posterior.over(low, high, FINE)
    tail = 0.5 * (1.0 - MASS)
    ends = _quantile(places, weights, tail), _quantile(places, weights, 1.0 - tail)
    return ends[0], ends[1] if ends[1] <= design.highest else None


class _Marginal:
    """The posterior of the threshold, summed over the scale."""

    def __init__(self, counts: Sequence[Count], curve: Curve, at: float) -> None:
        self._counts, self._first, self._unit = scaled(counts)
        self._core, self._early = curve.core, curve.early
        self._gain = 1.0 - curve.early - curve.late
        self._z = core_at(curve.core, curve.early, curve.late, at)

    def over(self, low: float, high: float, steps: int) -> tuple[list[float], list[float]]:
        """Thresholds from low to high, and the density at each, up to a factor."""
        places = [low + (high - low) * i / steps for i in range(steps + 1)]
        logs = [self._logs((place - self._first) / self._unit) for place in places]
        highest = max(max(row) for row in logs)
        return places, [math.fsum(math.exp(one - highest) for one in row) for row in logs]

    def _logs(self, threshold: float) -> list[float]:
        """The logarithm of the posterior at each scale."""
        return [self._log(threshold, log_scale) for log_scale in LOG_SCALES]

    def _log(self, threshold: float, log_scale: float) -> float:
        scale = math.exp(log_scale)
        total = -0.5 * log_scale * log_scale
        for level, noticed, of in self._counts:
            rise = rise_of(self._core, (level - threshold) / scale + self._z)[0]
            share = min(max(self._early + self._gain * rise, LEAST), 1.0 - LEAST)
            if noticed:
                total += noticed * math.log(share)
            if of > noticed:
                total += (of - noticed) * math.log(1.0 - share)
        return total


def _quantile(places: Sequence[float], weights: Sequence[float], share: float) -> float:
    """Where that share of the density, straight between the places, lies below."""
    parts = [0.5 * (a + b) for a, b in zip(weights, weights[1:])]
    left = share * math.fsum(parts)
    for i, part in enumerate(parts):
        if left <= part:
            a, b = weights[i], weights[i + 1]
            # a x + (b - a) x^2 / 2 = left, in units of the step
            root = math.sqrt(max(a * a + 2.0 * (b - a) * left, 0.0))
            x = 2.0 * left / (a + root) if a + root > 0.0 else 0.0
            return places[i] + min(x, 1.0) * (places[i + 1] - places[i])
        left -= part
    return places[-1]
