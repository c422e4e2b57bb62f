# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""The answers of a participant: a file of lines of JSON that only grows (docs/formats/study.md).
An answer is on the disk before the next question is asked; a line that a crash cut off is no
answer."""

from __future__ import annotations

import fcntl
import json
import os
from dataclasses import dataclass
from typing import Any, Optional

from hapnet.study.design import Design
from hapnet.study.plan import Plan, Trial

SCHEMA = "hapnet-study-answers/1"
NAME = "answers.jsonl"
LINE_BYTES_MAX = 1 << 16


class AnswersError(Exception):
    """Answers that do not belong to this design or participant, or are no answers."""


@dataclass(frozen=True)
class Answer:
    """One line: a trial and what was answered."""

    trial: Trial
    answer: str
    """"yes" or "no"; "1" or "2" of two intervals."""
    noticed: bool
    """The level was noticed, or its interval named."""
    is_valid: bool = True


def folder_of(out: str, participant: int) -> str:
    return os.path.join(out, f"participant-{participant:04d}")


def is_noticed(design: Design, trial: Trial, answer: str) -> bool:
    """Does the answer say that the participant noticed, or found, the level?"""
    return answer == (str(trial.worse) if design.two_intervals else design.noticed)


class Answers:
    """The file of a participant, held by this process alone while it is open. A context manager.
    Reading it plays the plan again, so that `plan` is at the first trial without an answer."""

    def __init__(self, design: Design, participant: int, out: str, head: dict[str, Any]) -> None:
        """`head`: the keys of a new file's first line besides design and participant. The first
        line of an existing file must have the same. Raises AnswersError and OSError."""
        self.folder = folder_of(out, participant)
        self.plan = Plan(design, participant)
        self.done: list[Answer] = []
        os.makedirs(self.folder, exist_ok=True)
        self.path = os.path.join(self.folder, NAME)
        self._design = design
        self._file = os.open(self.path, os.O_RDWR | os.O_CREAT | os.O_APPEND, 0o644)
        try:
            self._hold()
            self._read({"schema": SCHEMA, "design": design.digest(), "participant": participant,
                        **head})
        except BaseException:
            os.close(self._file)
            raise

    def __enter__(self) -> "Answers":
        return self

    def __exit__(self, *_: object) -> None:
        os.close(self._file)

    def take(self, trial: Trial, answer: str, more: dict[str, Any]) -> Answer:
        """Writes an answer; it is on the disk when this returns. `more`: further keys."""
        noticed = is_noticed(self._design, trial, answer)
        level = self._design.level_text(trial.level)
        self._write({"trial": trial.number, "block": trial.block, "level": level,
                     "is_catch": trial.is_catch, "staircase": trial.staircase,
                     "worse": trial.worse, "answer": answer, **more})
        done = Answer(trial, answer, noticed, not more.get("not_valid_because"))
        self.done.append(done)
        self.plan.take(noticed)
        return done

    def note_invalid(self, trial: Trial, why: list[str]) -> None:
        """Writes that a trial was played and was not valid."""
        self._write({"trial": trial.number, "invalid_because": why})

    def _hold(self) -> None:
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise AnswersError(f"{self.path}: another hapnet-study is asking this participant: "
                               "end it first") from None

    def _read(self, head: dict[str, Any]) -> None:
        lines, whole = read_lines(self._file, self.path)
        os.ftruncate(self._file, whole)
        if not lines:
            self._write(head)
            parent = os.open(self.folder, os.O_RDONLY)
            os.fsync(parent)  # the file is in its folder for good, too
            os.close(parent)
            return
        for key, value in head.items():
            if key != "version" and lines[0].get(key) != value:
                raise AnswersError(f"{self.path}:1: {key} is {lines[0].get(key)!r} there, and "
                                   f"{value!r} now: {CURES.get(key, 'use another --out')}")
        self.done = replayed(self._design, self.plan, lines[1:], self.path)

    def _write(self, line: dict[str, Any]) -> None:
        data = json.dumps(line, ensure_ascii=False).encode() + b"\n"
        size = os.fstat(self._file).st_size
        try:
            if os.write(self._file, data) != len(data):
                raise OSError(28, "the disk is full", self.path)
        except BaseException:
            os.ftruncate(self._file, size)
            raise
        os.fsync(self._file)


CURES = {
    "schema": "it is the file of another version; use another --out",
    "design": "the design has changed since; use another --out, or take the change back",
    "participant": "the folder was renamed; name it as it was",
    "observer": "use another --participant, or another --out",
    "dry": "use another --participant, or another --out",
}


def read_lines(file: int, path: str) -> tuple[list[dict[str, Any]], int]:
    """The whole lines of a file, and how many bytes they take."""
    data = b""
    try:
        while chunk := os.pread(file, 1 << 20, len(data)):
            data += chunk
    except OSError as refused:
        raise OSError(refused.errno, refused.strerror, path) from None
    whole = data.rfind(b"\n") + 1
    lines = []
    for number, line in enumerate(data[:whole].splitlines(), 1):
        try:
            found = json.loads(line[:LINE_BYTES_MAX])
        except (ValueError, RecursionError):
            found = None
        if not isinstance(found, dict):
            raise AnswersError(f"{path}:{number}: it is no line of answers: restore the file, or "
                               "use another --participant")
        lines.append(found)
    return lines, whole


def replayed(design: Design, plan: Plan, lines: list[dict[str, Any]], path: str) -> list[Answer]:
    """The answers of the lines after the first. `plan` goes on to the first trial without one."""
    allowed = ("1", "2") if design.two_intervals else ("yes", "no")
    done = []
    for number, line in enumerate(lines, 2):
        trial: Optional[Trial] = plan.next()
        if "invalid_because" in line:
            continue
        fits = trial is not None and (line.get("trial"), line.get("level"), line.get("worse")) == (
            trial.number, design.level_text(trial.level), trial.worse)
        if trial is None or not fits or line.get("answer") not in allowed:
            raise AnswersError(f"{path}:{number}: it is no answer to trial "
                               f"{trial.number if trial else 'of this design'}: restore the file, "
                               "or use another --participant")
        noticed = is_noticed(design, trial, line["answer"])
        done.append(Answer(trial, line["answer"], noticed, not line.get("not_valid_because")))
        plan.take(noticed)
    return done
