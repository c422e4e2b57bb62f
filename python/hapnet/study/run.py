# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""One participant's trials, from the first without an answer to the last."""

from __future__ import annotations

import json
import os
import platform
import time
from typing import Any, Optional, Union

import hapnet
from hapnet.results import write_whole
from hapnet.study import quantity
from hapnet.study.answers import Answers
from hapnet.study.design import Design
from hapnet.study.observer import Person, Simulated
from hapnet.study.plan import Trial
from hapnet.study.stage import EmergencyStop, Played, Stage

TRIES = 3


class NeverValid(Exception):
    """A trial that was not valid so often that it is no use to go on."""


def say(text: str) -> None:
    print(text, flush=True)


class Run:
    """Asks one participant. `stage` None: nothing is played (--dry). `keeps_invalid`: a trial
    that was not valid is asked about nevertheless, and marked."""

    def __init__(self, design: Design, answers: Answers, who: Union[Person, Simulated],
                 stage: Optional[Stage], keeps_invalid: bool = False) -> None:
        self._design, self._answers, self._who, self._stage = design, answers, who, stage
        self._keeps_invalid = keeps_invalid
        self._block = 0

    def to_the_end(self) -> int:
        """Plays and asks; returns how many answers there are then. What was answered is on the
        disk, however this ends."""
        if self._answers.done:
            say(f"{len(self._answers.done)} trials are answered; going on with the next.")
        while (trial := self._answers.plan.next()) is not None:
            if trial.block != self._block:
                self._begin_block(trial)
            self._one(trial)
        return len(self._answers.done)

    def _begin_block(self, trial: Trial) -> None:
        blocks = self._design.blocks
        if self._who.is_person:
            if self._block and self._design.break_s:
                self._who.begin(f"A break: {quantity.span(self._design.break_s)}, or less.")
            self._who.begin(f"Block {trial.block} of {blocks}. "
                            "Enter during a trial ends the force.")
        self._block = trial.block

    def _one(self, trial: Trial) -> None:
        if self._who.is_person or self._stage is not None:
            say(f"\nTrial {trial.number}{self._of()}")
        played = self._played(trial)
        begin = time.monotonic()
        answer = self._who.ask(trial)
        more: dict[str, Any] = {"answered_after_s": round(time.monotonic() - begin, 3)}
        if self._stage is not None:
            more.update(records=played.records, discrepancy_mm=played.discrepancy_mm,
                        not_valid_because=played.invalid_because)
        self._answers.take(trial, answer, more)
        if self._who.is_person:
            say("Noted.")

    def _played(self, trial: Trial) -> Played:
        """The trial, played again while it is not valid: TRIES plays at most."""
        if self._stage is None:
            return Played()
        for plays_left in reversed(range(TRIES)):
            try:
                played = self._stage.play(trial, self._answers.folder, say, self._who.is_stopped)
            except EmergencyStop:
                self._answers.note_invalid(trial, ["emergency stop"])
                self._who.begin("Stopped: no force. The trial is played again.")
                return self._played(trial)
            if not played.invalid_because or self._keeps_invalid:
                return played
            self._answers.note_invalid(trial, played.invalid_because)
            why = "; ".join(played.invalid_because)
            say(f"The trial was not valid ({why})" + ("; once more." if plays_left else "."))
        raise NeverValid(f"trial {trial.number} was not valid {TRIES} times: close what else runs, "
                         "see docs/use/build.md on real-time priority, and start the same command "
                         "again")

    def _of(self) -> str:
        design = self._design
        if design.staircase:
            return ""
        levels = design.repetitions * len(design.levels)
        return f" of {levels + design.blocks * design.catch_trials}"


def write_manifest(folder: str, design: Design, command: str, started: float,
                   answers: Answers, dry: bool) -> None:
    """What the last run of this participant was, beside the answers."""
    manifest = {
        "command": command,
        "version": hapnet.__version__,
        "host": {"machine": platform.machine(), "system": platform.system(),
                 "release": platform.release(), "cores": os.cpu_count()},
        "start": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(started)),
        "wall_time_s": round(time.time() - started, 3),
        "seed": design.seed,
        "design": design.digest(),
        "dry": dry,
        "trials": len(answers.done),
        "complete": answers.plan.next() is None,
    }
    write_whole(os.path.join(folder, "manifest.json"), json.dumps(manifest, indent=2) + "\n")
