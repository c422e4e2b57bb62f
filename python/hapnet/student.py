# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""The mean of a few values, and its 95 % interval by Student's distribution."""

from __future__ import annotations

import math
from typing import Optional, Sequence


def within(t: float, degrees: int) -> float:
    """The share of Student's distribution from -t to t (Abramowitz and Stegun 26.7.3, 26.7.4)."""
    angle = math.atan(t / math.sqrt(degrees))
    cosine, sine = math.cos(angle), math.sin(angle)
    odd = degrees % 2
    term, total = (cosine, 0.0) if odd else (1.0, 0.0)
    for i in range(degrees // 2):
        total += term
        up, down = (2 * i + 2, 2 * i + 3) if odd else (2 * i + 1, 2 * i + 2)
        term *= cosine * cosine * up / down
    return 2.0 / math.pi * (angle + sine * total) if odd else sine * total


def quantile_975(degrees: int) -> float:
    """Student's 97.5th percentile, to 1e-9."""
    low, high = 1.0, 13.0
    for _ in range(40):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if within(middle, degrees) < 0.95 else (low, middle)
    return high


def mean_of(values: Sequence[float]) -> tuple[float, Optional[float], Optional[float]]:
    """The mean of at least one value, and the ends of its 95 % interval; None for a single value.
    The mean of equal values is that value, whatever their sum is rounded to."""
    count = len(values)
    mean = min(max(math.fsum(values) / count, min(values)), max(values))
    if count < 2:
        return mean, None, None
    spread = math.sqrt(math.fsum((one - mean) ** 2 for one in values) / (count - 1))
    reach = quantile_975(count - 1) * spread / math.sqrt(count)
    return mean, mean - reach, mean + reach
