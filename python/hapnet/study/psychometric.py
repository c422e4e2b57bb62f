# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""The psychometric function of the lab (lab/metrics/psychometric.hpp) and its fit, for answers:

    psi(x) = early + (1 - early - late) F((x - a) / s)

`early` is the share of trials that are noticed however small the level is, `late` the share that
is missed however large it is. F is the logistic 1 / (1 + exp(-z)), or Gumbel's 1 - exp(-exp(z))
where that is clearly likelier. a and s have the greatest posterior probability with the lab's weak
prior: log s is normal about the distance of the levels, with a standard deviation of 1 (after
Kuss, Jaekel and Wichmann, "Bayesian inference for psychometric functions", Journal of Vision 5,
2005, 478-492). Where one of two intervals has to be chosen, `early` is the share of lucky guesses,
one half (Wichmann and Hill, "The psychometric function: I. Fitting, sampling, and goodness of
fit", Perception & Psychophysics 63, 2001, 1293-1313)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple, Optional, Sequence

LAPSES = (0.0, 0.025, 0.05)
CORES = ("logistic", "gumbel")
EVIDENCE = 2.0  # by how much likelier Gumbel's core has to be, as a logarithm
LOG_SCALE_MAX = 4.0
STEPS_MAX = 40
FLAT = 1e-7
LEAST = 1e-9


class Count(NamedTuple):
    """How many of how many trials were noticed, or right, at a level."""

    level: float
    noticed: float
    of: float


@dataclass(frozen=True)
class Kind:
    """What is asked: which lapses there may be, and which share of answers is the threshold's."""

    lapses: tuple[tuple[float, float], ...]
    at: float


YES_NO = Kind(tuple((early, late) for early in LAPSES for late in LAPSES), 0.5)
TWO_INTERVALS = Kind(tuple((0.5, late) for late in LAPSES), 0.75)


@dataclass(frozen=True)
class Curve:
    """A psychometric function."""

    location: float
    scale: float
    early: float = 0.0
    late: float = 0.0
    core: str = "logistic"

    def share_at(self, level: float) -> float:
        """The share of trials that are noticed, or right, at a level."""
        rise = rise_of(self.core, (level - self.location) / self.scale)[0]
        return self.early + (1.0 - self.early - self.late) * rise

    def level_of(self, share: float) -> float:
        """The level at which that share is; early < share < 1 - late."""
        return self.location + self.scale * core_at(self.core, self.early, self.late, share)


def core_at(core: str, early: float, late: float, share: float) -> float:
    """z at which a curve with these lapses reaches the share."""
    f = (share - early) / (1.0 - early - late)
    return math.log(f / (1.0 - f)) if core == "logistic" else math.log(-math.log(1.0 - f))


def rise_of(core: str, z: float) -> tuple[float, float]:
    """F(z) and its slope."""
    if core == "logistic":
        share = 1.0 / (1.0 + math.exp(-max(-30.0, min(30.0, z))))
        return share, share * (1.0 - share)
    rate = math.exp(max(-30.0, min(3.4, z)))  # beyond, exp(-rate) is 1e-13
    passes = math.exp(-rate)
    return 1.0 - passes, rate * passes


class Posterior:
    """The posterior of a curve with given core and lapses. Levels are in units of their distance,
    as in scaled()."""

    def __init__(self, counts: Sequence[Count], core: str, early: float, late: float) -> None:
        self.counts, self.core, self.early, self.late = counts, core, early, late
        self._gain = 1.0 - early - late

    def at(self, location: float, log_scale: float) -> float:
        """Its logarithm, but for a constant."""
        total = -0.5 * log_scale * log_scale
        scale = math.exp(log_scale)
        for level, noticed, of in self.counts:
            share = self._share((level - location) / scale)
            total += noticed * math.log(share) + (of - noticed) * math.log(1.0 - share)
        return total

    def step(self, location: float, log_scale: float) -> tuple[float, float]:
        """One step of Fisher scoring: expected curvature, so that it always climbs."""
        g_a, g_t, h_aa, h_at, h_tt = self._slopes(location, log_scale)
        determinant = h_aa * h_tt - h_at * h_at
        return (h_tt * g_a - h_at * g_t) / determinant, (h_aa * g_t - h_at * g_a) / determinant

    def step_along(self, location: float, log_scale: float, z: float) -> float:
        """The same for log_scale alone, where location + z scale does not change."""
        g_a, g_t, h_aa, h_at, h_tt = self._slopes(location, log_scale)
        along = -z * math.exp(log_scale)  # how the location follows
        return (g_t + along * g_a) / (h_tt + 2.0 * along * h_at + along * along * h_aa)

    def _slopes(self, location: float, log_scale: float) -> tuple[float, ...]:
        scale = math.exp(log_scale)
        g_a, g_t, h_aa, h_at, h_tt = 0.0, -log_scale, 1e-6, 0.0, 1.0
        for level, noticed, of in self.counts:
            z = (level - location) / scale
            rise, slope = rise_of(self.core, z)
            share = min(max(self.early + self._gain * rise, LEAST), 1.0 - LEAST)
            d_a = -self._gain * slope / scale
            d_t = d_a * scale * z
            spread = share * (1.0 - share)
            pull, weight = (noticed - of * share) / spread, of / spread
            g_a += pull * d_a
            g_t += pull * d_t
            h_aa += weight * d_a * d_a
            h_at += weight * d_a * d_t
            h_tt += weight * d_t * d_t
        return g_a, g_t, h_aa, h_at, h_tt

    def _share(self, z: float) -> float:
        share = self.early + self._gain * rise_of(self.core, z)[0]
        return min(max(share, LEAST), 1.0 - LEAST)


def scaled(counts: Sequence[Count]) -> tuple[list[Count], float, float]:
    """The counts with their levels in units of the levels' distance, the first level, the unit."""
    first = counts[0].level
    unit = (counts[-1].level - first) / (len(counts) - 1)
    return [Count((level - first) / unit, n, of) for level, n, of in counts], first, unit


def fitted(counts: Sequence[Count], kind: Kind = YES_NO) -> Curve:
    """The curve of these counts: levels ascending, two at least, each with a trial or more."""
    inner, first, unit = scaled(counts)
    best: Optional[Curve] = None
    highest = 0.0
    for core in CORES:
        # Gumbel only on evidence: where the levels show no shape, half-way is the honest guess.
        to_beat = highest + (EVIDENCE if core == "gumbel" else 0.0)
        location, log_scale = _crossing(inner, kind.at), 0.0
        for early, late in kind.lapses:
            posterior = Posterior(inner, core, early, late)
            location, log_scale = _climbed(posterior, location, log_scale)
            height = posterior.at(location, log_scale)
            if best is not None and height <= to_beat + 1e-6:
                continue  # the simplest that does
            to_beat = highest = height
            best = Curve(first + unit * location, unit * math.exp(log_scale), early, late, core)
    assert best is not None
    return best


def _climbed(posterior: Posterior, location: float, log_scale: float) -> tuple[float, float]:
    """Uphill until it is flat; a step that leads down, or far away, is halved."""
    width = posterior.counts[-1].level
    height = posterior.at(location, log_scale)
    for _ in range(STEPS_MAX):
        step_a, step_t = posterior.step(location, log_scale)
        share, next_a, next_t, gained = 1.0, location, log_scale, 0.0
        for _ in range(12):
            next_a = max(-width, min(2.0 * width, location + share * step_a))
            next_t = max(-LOG_SCALE_MAX, min(LOG_SCALE_MAX, log_scale + share * step_t))
            gained = posterior.at(next_a, next_t) - height
            if gained >= 0.0:
                break
            share /= 2.0
        if gained <= FLAT:
            break
        location, log_scale, height = next_a, next_t, height + gained
    return location, log_scale


def _crossing(counts: Sequence[Count], share: float) -> float:
    """Where straight lines between the levels reach the share: where the climb begins."""
    for before, count in zip([None, *counts], counts):
        here = count.noticed / count.of
        if here < share:
            continue
        if before is None:
            return count.level
        there = before.noticed / before.of
        part = (share - there) / max(here - there, 1e-9)
        return before.level + part * (count.level - before.level)
    return counts[-1].level
