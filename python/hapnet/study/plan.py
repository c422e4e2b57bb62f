# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""The trials of a participant, in their order. It follows from the design, the participant's
number and, with staircases, the answers alone: the same number always meets the same trials.

Levels come in rounds; each round has every level once. The orders of the rounds are the rows of a
Williams design (Williams, "Experimental designs balanced for the estimation of residual effects of
treatments", Australian Journal of Scientific Research A 2, 1949, 149-168): over its n rows, or 2 n
for an odd number n of levels, every level stands equally often at every place, and follows every
other equally often. Participant p begins with row p, so that rows are balanced over participants,
too."""

from __future__ import annotations

import random
from dataclasses import dataclass
from typing import Iterator, Optional

from hapnet.study.design import Design
from hapnet.study.staircase import Track


@dataclass(frozen=True)
class Trial:
    number: int
    """From 1 on, over all blocks."""
    block: int
    """From 1 on."""
    level: float
    """Level of the factor; the reference in a catch trial."""
    is_catch: bool
    staircase: Optional[int]
    """Number of the staircase in the design, from 1; None for constant stimuli and catch trials."""
    worse: Optional[int]
    """Interval with the level, 1 or 2; None if there is one interval. In a catch trial both are the
    reference, and `worse` has no meaning."""


def williams(levels: int) -> list[list[int]]:
    """The rows of a Williams design for the levels 0 to levels - 1."""
    first = [0]
    for i in range(1, levels):
        first.append((i + 1) // 2 if i % 2 else levels - i // 2)
    rows = [[(one + shift) % levels for one in first] for shift in range(levels)]
    if levels % 2:
        rows += [row[::-1] for row in rows]
    return rows


class Plan:
    """The trials of a participant. next() returns the same trial until take() has its answer; None:
    all trials are done."""

    def __init__(self, design: Design, participant: int) -> None:
        self._design, self._participant = design, participant
        self._number = 0
        self._sides: dict[tuple[str, int], list[int]] = {}
        self._due: Optional[Trial] = None
        self._track: Optional[Track] = None  # whose trial is due
        self._rest = self._staircases() if design.staircase else self._rounds()
        self._go_on()

    def next(self) -> Optional[Trial]:
        return self._due

    def take(self, noticed: bool) -> None:
        """The answer to the trial that is due."""
        assert self._due is not None
        if self._track is not None and not self._due.is_catch:
            self._track.take(noticed)
        self._go_on()

    def _go_on(self) -> None:
        self._due = next(self._rest, None)

    def _stream(self, purpose: str) -> random.Random:
        return random.Random(f"hapnet-study/{self._design.seed}/{self._participant}/{purpose}")

    def _trial(self, block: int, level: float, of: str, staircase: Optional[int] = None) -> Trial:
        self._number += 1
        side = self._side(of, staircase or 0) if self._design.two_intervals else None
        return Trial(self._number, block, level, of == "catch", staircase, side)

    def _side(self, of: str, staircase: int) -> int:
        """Balanced within every four trials of the same level, staircase, or kind."""
        left = self._sides.setdefault((of, staircase), [])
        if not left:
            left += shuffled([1, 1, 2, 2], self._stream(f"side/{of}/{staircase}/{self._number}"))
        return left.pop()

    def _catch_places(self, block: int, trials: int) -> list[int]:
        """After how many other trials of the block the catch trials come."""
        stream = self._stream(f"catch/{block}")
        return sorted(below(stream, trials + 1) for _ in range(self._design.catch_trials))

    def _rounds(self) -> Iterator[Trial]:
        design = self._design
        rows = williams(len(design.levels))
        rounds = design.repetitions // design.blocks
        for block in range(1, design.blocks + 1):
            first = (block - 1) * rounds
            order = [level for one in range(first, first + rounds)
                     for level in rows[(self._participant - 1 + one) % len(rows)]]
            places = self._catch_places(block, len(order))
            for place, level in enumerate([*order, -1]):
                while places and places[0] == place:
                    places.pop(0)
                    yield self._trial(block, design.reference, "catch")
                if level >= 0:
                    yield self._trial(block, design.levels[level], f"level {level}")

    def _staircases(self) -> Iterator[Trial]:
        """The staircases of a block take turns at random."""
        design, rule = self._design, self._design.staircase
        assert rule is not None
        each = design.repetitions // design.blocks
        turns = self._stream("turns")
        for block in range(1, design.blocks + 1):
            tracks = {(block - 1) * each + i + 1: Track(rule) for i in range(each)}
            places = self._catch_places(block, each * rule.reversals)
            done = 0
            while tracks:
                while places and places[0] <= done:
                    places.pop(0)
                    yield self._trial(block, design.reference, "catch")
                names = list(tracks)
                name = names[below(turns, len(names))]
                self._track = tracks[name]
                yield self._trial(block, self._track.level, "staircase", name)
                done += 1
                if self._track.is_over:
                    del tracks[name]


def below(stream: random.Random, count: int) -> int:
    """A number from 0 to count - 1. random() alone is promised to stay the same in all versions of
    Python."""
    return int(stream.random() * count)


def shuffled(items: list[int], stream: random.Random) -> list[int]:
    """The items in a random order (Fisher and Yates)."""
    items = list(items)
    for i in range(len(items) - 1, 0, -1):
        j = below(stream, i + 1)
        items[i], items[j] = items[j], items[i]
    return items
