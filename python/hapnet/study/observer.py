# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Who answers: a person at the terminal, or a simulated observer with a known curve."""

from __future__ import annotations

import random
import select
import sys
import termios
from typing import Optional

from hapnet.study.design import Design
from hapnet.study.plan import Trial
from hapnet.study.psychometric import Curve


class Left(Exception):
    """The end of the input: there is no one left to answer."""


def curve_of(design: Design) -> Curve:
    """The curve by which the design's observer notices a level: a logistic. With two intervals the
    same curve says which trials need no guess."""
    observer = design.observer
    assert observer is not None
    return Curve(observer.threshold, observer.threshold / observer.slope)


class Simulated:
    """Answers by the curve of the design's `observer`. The answer to a trial follows from the
    participant's number and the trial alone."""

    is_person = False

    def __init__(self, design: Design, participant: int) -> None:
        assert design.observer is not None
        self._design, self._participant = design, participant
        self._curve, self._lapse = curve_of(design), design.observer.lapse

    def begin(self, text: str) -> None:
        """A simulated observer is always ready."""

    def is_stopped(self) -> bool:
        return False

    def ask(self, trial: Trial) -> str:
        design = self._design
        words = f"hapnet-study/{design.seed}/{self._participant}/answer/{trial.number}"
        stream = random.Random(words)
        luck, lapses, guess = stream.random(), stream.random() < self._lapse, stream.random()
        level = design.reference if trial.is_catch else trial.level
        notices = luck < self._curve.share_at(level) and not lapses
        if design.two_intervals:
            if notices and not trial.is_catch:
                return str(trial.worse)
            return "1" if guess < 0.5 else "2"
        noticed = guess < 0.5 if lapses else notices
        return design.noticed if noticed else {"yes": "no", "no": "yes"}[design.noticed]


class Person:
    """Asks on the terminal, or whatever stdin and stdout are."""

    is_person = True
    words = {"y": "yes", "yes": "yes", "n": "no", "no": "no", "1": "1", "2": "2"}

    def __init__(self, design: Design) -> None:
        self._design = design
        self._allowed = ("1", "2") if design.two_intervals else ("yes", "no")

    def begin(self, text: str) -> None:
        """Waits for Enter."""
        self._line(f"{text} Enter goes on: ")

    def is_stopped(self) -> bool:
        """Was Enter pressed while an interval is played? Only a terminal can say so."""
        if not sys.stdin.isatty() or not select.select([sys.stdin], [], [], 0.0)[0]:
            return False
        return sys.stdin.readline() != ""

    def ask(self, trial: Trial) -> str:
        """Asks until the answer is one of those that there are."""
        choices = "/".join(self._allowed)
        while True:
            line = self._line(f"{self._design.question} [{choices}] ")
            answer = self.words.get(line.strip().lower(), "")
            if answer in self._allowed:
                return answer
            print(f"Please answer {self._allowed[0]} or {self._allowed[1]}.", flush=True)

    def _line(self, prompt: str) -> str:
        if sys.stdin.isatty():
            termios.tcflush(sys.stdin, termios.TCIFLUSH)  # text typed before the question
        print(prompt, end="", flush=True)
        line: Optional[str] = sys.stdin.readline()
        if not line:
            print(flush=True)
            raise Left
        return line
