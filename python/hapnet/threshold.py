# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""The level at which half of the sessions fail, and its 95 % interval, as hapnet-lab finds them
(lab/metrics/psychometric.hpp): equal outcomes give equal numbers. docs/design/metrics.md has the
method."""

from __future__ import annotations

import functools
import math
from statistics import NormalDist
from typing import Dict, Iterator, NamedTuple, Optional, Sequence, Tuple

from hapnet.student import quantile_975
from hapnet.study.psychometric import Count, fitted

REPLICATES = 1000
WORD = 0xFFFFFFFF


class Threshold(NamedTuple):
    """The levels at which a half (`p50`) and a tenth (`p10`) of the sessions fail, and the 95 %
    interval of p50. `bound` is "=", or ">" if less than half fail at the highest level, which p50
    then is. `p10` is None above the levels, and `ci_high` is None where it is above them."""

    p50: float
    bound: str
    p10: Optional[float]
    ci_low: float
    ci_high: Optional[float]


@functools.lru_cache(maxsize=1000)
def threshold_of(levels: Tuple[float, ...], failed: Tuple[Tuple[bool, ...], ...]) -> Threshold:
    """The threshold of at least two levels of 0 or more, ascending. `failed`: for each level
    whether the session of each seed failed, in one order of at least one seed."""
    seeds, top = len(failed[0]), levels[-1]
    counts = _counts(levels, failed, [1] * seeds)
    curve = fitted(counts)
    p50, p10 = (max(curve.level_of(share), 0.0) for share in (0.5, 0.1))
    found: Dict[Tuple[float, ...], float] = {}  # fits of replicates with equal counts
    replicates = []
    for weights in drawn_weights(seeds):
        drawn = _counts(levels, failed, weights)
        key = tuple(count.noticed for count in drawn)
        if key not in found:
            at = max(fitted(drawn).level_of(0.5), 0.0)
            found[key] = at if at <= top else math.inf
        replicates.append(found[key])
    low, high = _interval_of(replicates, seeds)
    gap = _gap_of(counts)
    if gap is not None:
        low, high = min(low, gap[0]), max(high, gap[1])
    is_open = p50 > top
    return Threshold(min(p50, top), ">" if is_open else "=", p10 if p10 <= top else None,
                     min(low, top), None if is_open or high == math.inf else high)


def _counts(levels: Sequence[float], failed: Sequence[Sequence[bool]],
            weights: Sequence[int]) -> list[Count]:
    of = sum(weights)
    return [Count(level, sum(weight for weight, one in zip(weights, outcomes) if one), of)
            for level, outcomes in zip(levels, failed)]


def _interval_of(values: Sequence[float], seeds: int) -> Tuple[float, float]:
    """The expanded percentiles of replicates (Hesterberg, "What Teachers Should Know About the
    Bootstrap", The American Statistician 69, 2015, 371-386), by nearest rank."""
    share = 0.025
    if seeds > 1:
        share = NormalDist().cdf(-math.sqrt(seeds / (seeds - 1)) * quantile_975(seeds - 1))
    rank = max(math.ceil(share * len(values)), 1)
    ordered = sorted(values)
    return ordered[rank - 1], ordered[-rank]


def _gap_of(counts: Sequence[Count]) -> Optional[Tuple[float, float]]:
    """The gap between two levels in which one half is crossed. None: the number of failures at a
    level is compatible with one half by a two-sided sign test at 5 %, or their order leaves the
    place open."""
    of = int(counts[0].of)
    fewest, total = 0, 0.5 ** of
    while total <= 0.025:
        fewest += 1
        total += math.comb(of, fewest) * 0.5 ** of
    fewest = max(fewest, 1)
    low, high = 0.0, math.inf
    for count in counts:
        is_below, is_above = count.noticed < fewest, of - count.noticed < fewest
        if is_below == is_above:
            return None
        if is_below:
            low = count.level
        else:
            high = min(high, count.level)
    return (low, high) if low <= high else None


@functools.lru_cache(maxsize=4)
def drawn_weights(seeds: int) -> Tuple[Tuple[int, ...], ...]:
    """How often each of the seeds occurs in each bootstrap replicate. The draws are those of the
    lab: 1000 replicates, each of as many draws as there are seeds."""
    drawn = []
    for replicate in range(REPLICATES):
        weights = [0] * seeds
        for word in _words("bootstrap of seeds", seeds, replicate):
            weights[word * seeds >> 32] += 1
        drawn.append(tuple(weights))
    return tuple(drawn)


def _words(name: str, count: int, draw: int) -> Iterator[int]:
    """`count` uniform words of 32 bits from the stream of seed 1 with a name, as
    proto/base/random.hpp has them."""
    named = 0xCBF29CE484222325
    for one in name.encode():  # FNV-1a
        named = (named ^ one) * 0x100000001B3 & (1 << 64) - 1
    low, high, domain, _ = _philox((named & WORD, named >> 32, 0, 1), (1, 0))
    for index in range(count):
        yield _philox((index, 0, draw, domain), (low, high))[1]


def _philox(counter: Tuple[int, int, int, int], key: Tuple[int, int]) -> Tuple[int, int, int, int]:
    """Philox-4x32-10 (Salmon et al., "Parallel Random Numbers: As Easy as 1, 2, 3", SC 2011)."""
    for _ in range(10):
        first, second = 0xD2511F53 * counter[0], 0xCD9E8D57 * counter[2]
        counter = (second >> 32 ^ counter[1] ^ key[0], second & WORD,
                   first >> 32 ^ counter[3] ^ key[1], first & WORD)
        key = (key[0] + 0x9E3779B9 & WORD, key[1] + 0xBB67AE85 & WORD)
    return counter
