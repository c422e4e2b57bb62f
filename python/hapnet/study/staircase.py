# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""One staircase: the level of its next trial follows from the answers to those before."""

from __future__ import annotations

from hapnet.study.design import Staircase


class Track:
    """A transformed up-down staircase under way."""

    def __init__(self, rule: Staircase) -> None:
        self._rule = rule
        self.level = rule.start
        """The level of the next trial."""
        self.reversals = 0
        self.trials = 0
        self._in_a_row = 0  # noticed; below 0: missed
        self._direction = 0

    @property
    def is_over(self) -> bool:
        return self.reversals >= self._rule.reversals or self.trials >= self._rule.trials

    def take(self, noticed: bool) -> None:
        """The answer to the trial at `level`. A step that the ends of the range cut off counts as
        one, so that a staircase which stays at an end ends by `trials`."""
        self.trials += 1
        if noticed:
            self._in_a_row = max(self._in_a_row, 0) + 1
        else:
            self._in_a_row = min(self._in_a_row, 0) - 1
        if self._in_a_row >= self._rule.down:
            self._go(-1)
        elif -self._in_a_row >= self._rule.up:
            self._go(1)

    def _go(self, direction: int) -> None:
        self._in_a_row = 0
        if self._direction not in (0, direction):
            self.reversals += 1
        self._direction = direction
        level = round(self.level + direction * self._rule.step, 9)
        self.level = min(max(level, self._rule.lowest), self._rule.highest)
