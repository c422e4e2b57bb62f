# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""The design of a study, read from TOML and checked whole (docs/formats/study.md)."""

from __future__ import annotations

import difflib
import hashlib
import json
import os
import re
import tomllib
from dataclasses import dataclass
from typing import Any, Callable, Optional

from hapnet.study import quantity

FACTORS = {  # condition: its unit; more of each is worse
    "delay": "ms",
    "jitter": "ms",
    "loss": "%",
    "corrupt": "%",
    "duplicate": "%",
}
WAYS = ("up", "down", "both")
TASKS = tuple(f"T{i}" for i in range(1, 7)) + ("P1",)
LEVELS_MAX, REPETITIONS_MAX, TRIALS_MAX = 50, 1000, 10_000
FILE_BYTES_MAX = 1 << 20
KEYS = {  # keys of a table, by its name
    "": ("title", "factor", "levels", "staircase", "reference", "question", "noticed",
         "two_intervals", "repetitions", "blocks", "break", "catch_trials", "task", "duration",
         "algorithm", "scene", "conditions", "seed", "observer"),
    "staircase.": ("start", "step", "down", "up", "reversals", "lowest", "highest", "trials"),
    "observer.": ("threshold", "slope", "lapse"),
}


class DesignError(Exception):
    """A design that cannot be played: FILE:LINE: KEY: what is wrong, and the cure."""


@dataclass(frozen=True)
class Staircase:
    """A transformed up-down staircase (Levitt, "Transformed up-down methods in psychoacoustics",
    JASA 49, 1971, 467-477)."""

    start: float
    step: float
    down: int
    """How many noticed in a row lead a step down."""
    up: int
    """How many missed in a row lead a step up."""
    reversals: int
    """Changes of direction, after which it ends."""
    lowest: float
    highest: float
    trials: int
    """Trials after which it ends, whatever the reversals."""


@dataclass(frozen=True)
class Observer:
    """Who answers by a known curve: the logistic of slope (level / threshold - 1)."""

    threshold: float
    slope: float
    lapse: float
    """Share of trials that are answered at random."""


@dataclass(frozen=True)
class Design:
    file: str
    title: str
    factor: str
    unit: str
    levels: tuple[float, ...]
    """Ascending; empty for a staircase."""
    staircase: Optional[Staircase]
    reference: float
    question: str
    noticed: str
    two_intervals: bool
    repetitions: int
    blocks: int
    break_s: float
    catch_trials: int
    task: str
    duration_s: float
    algorithm: str
    scene: Optional[str]
    conditions: tuple[tuple[str, str], ...]
    seed: int
    observer: Optional[Observer]

    @property
    def lowest(self) -> float:
        """The end of the range of levels."""
        return self.staircase.lowest if self.staircase else self.levels[0]

    @property
    def highest(self) -> float:
        return self.staircase.highest if self.staircase else self.levels[-1]

    def level_text(self, level: float) -> str:
        return quantity.text(level, self.unit)

    def digest(self) -> str:
        """A hash of all that decides what is played and asked. Title, observer and `noticed`, which
        may be mended after the trials, are left out."""
        words = {k: v for k, v in vars(self).items()
                 if k not in ("file", "title", "noticed", "observer", "break_s")}
        words["staircase"] = vars(self.staircase) if self.staircase else None
        return hashlib.sha256(json.dumps(words, sort_keys=True).encode()).hexdigest()[:16]


def read_design(path: str) -> Design:
    """Reads a design. Raises DesignError, which names the place, and OSError."""
    with open(path, "rb") as file:
        data = file.read(FILE_BYTES_MAX + 1)
    if len(data) > FILE_BYTES_MAX:
        raise DesignError(f"{path}: it is larger than 1 MiB: is it a design?")
    try:
        source = data.decode()
        table = tomllib.loads(source)
    except UnicodeDecodeError as wrong:
        raise DesignError(f"{path}: it is no UTF-8 text, from byte {wrong.start} on") from None
    except tomllib.TOMLDecodeError as wrong:
        where = re.search(r" \(at line (\d+), column (\d+)\)$", str(wrong))
        words = str(wrong)[: where.start()] if where else str(wrong)
        place = f":{where[1]}:{where[2]}" if where else ""
        raise DesignError(f"{path}{place}: {words}: see https://toml.io") from None
    except RecursionError:
        raise DesignError(f"{path}: its tables are nested too deep") from None
    return _Reader(path, source, table).design()


class _Reader:
    """Takes the keys of a table one after the other. Unknown keys are refused first."""

    def __init__(self, path: str, source: str, table: dict[str, Any], before: str = "") -> None:
        self._path, self._source, self._table, self._before = path, source, table, before
        known = KEYS[before]
        for key in table:
            if key not in known:
                near = difflib.get_close_matches(key, known, 1)
                cure = f"did you mean '{near[0]}'?" if near else f"use {', '.join(known)}"
                raise self.fail(key, f"unknown key: {cure}")

    def fail(self, key: str, words: str) -> DesignError:
        last = re.escape(key)
        found = re.search(rf'^[^#\n]*?(?<![\w.-])"?{last}"?\s*[=.]', self._source, re.MULTILINE)
        if found is None:
            found = re.search(rf"^\s*\[+\s*{last}", self._source, re.MULTILINE)
        line = f":{self._source.count(chr(10), 0, found.end()) + 1}" if found else ""
        name = key if key.isprintable() else repr(key)
        return DesignError(f"{self._path}{line}: {self._before}{name}: {words}")

    def take(self, key: str, default: Any, read: Callable[[Any], Any]) -> Any:
        """The value of a key, as `read` makes it; the default without it."""
        if key not in self._table:
            return default
        try:
            return read(self._table[key])
        except ValueError as wrong:
            raise self.fail(key, str(wrong)) from None

    def table(self, key: str) -> Optional["_Reader"]:
        """A table under a key, to be taken apart likewise."""
        value = self.take(key, None, _a_table)
        if value is None:
            return None
        return _Reader(self._path, self._source, value, f"{self._before}{key}.")

    def design(self) -> Design:
        stem = os.path.splitext(os.path.basename(self._path))[0]
        title = self.take("title", stem, _a_text)
        factor = self.take("factor", None, _a_factor)
        if factor is None:
            raise self.fail("factor", 'it is missing: say what changes, as factor = "both.delay"')
        unit = FACTORS[factor.split(".")[1]]

        def level(value: Any) -> float:
            return quantity.parse(value, unit)

        levels = self.take("levels", None, lambda value: _levels(value, unit))
        reference = self.take("reference", 0.0, level)
        stairs = self.table("staircase")
        if (levels is None) == (stairs is None):
            which = "it is missing" if levels is None else "there is a staircase, too"
            raise self.fail("levels", f"{which}: write either levels or staircase")
        staircase = _staircase(stairs, unit, reference) if stairs else None
        question = self.take("question", None, _a_text)
        two_intervals = self.take("two_intervals", False, _a_flag)
        if question is None and not two_intervals:
            raise self.fail("question", "it is missing: write a question that is answered by yes "
                                        "or no, or two_intervals = true")
        noticed = self.take("noticed", "yes", _one_of("yes", "no"))
        repetitions = self.take("repetitions", 2 if stairs else 10, _a_count(1, REPETITIONS_MAX))
        blocks = self.take("blocks", 1, _a_count(1, REPETITIONS_MAX))
        if repetitions % blocks:
            raise self.fail("blocks", f"{repetitions} repetitions do not divide into {blocks} "
                                      "equal blocks: change one of the two")
        design = Design(
            file=self._path,
            title=title,
            factor=factor,
            unit=unit,
            levels=levels or (),
            staircase=staircase,
            reference=reference,
            question=question or "Which of the two was worse: 1 or 2?",
            noticed=noticed,
            two_intervals=two_intervals,
            repetitions=repetitions,
            blocks=blocks,
            break_s=self.take("break", 60.0, _a_time(0.0, 86_400.0)),
            catch_trials=self.take("catch_trials", 0, _a_count(0, 100)),
            task=self.take("task", "T1", _one_of(*TASKS)),
            duration_s=self.take("duration", 8.0, _a_time(1.0, 3600.0)),
            algorithm=self.take("algorithm", "base", _a_text),
            scene=self.take("scene", None, _a_text),
            conditions=self.take("conditions", (), lambda value: _conditions(value, factor)),
            seed=self.take("seed", 1, _a_count(0, 2**32 - 1)),
            observer=_observer(self.table("observer"), unit),
        )
        self._judge(design)
        return design

    def _judge(self, design: Design) -> None:
        """What a key alone cannot tell."""
        if design.levels and design.two_intervals and design.reference in design.levels:
            same = design.level_text(design.reference)
            raise self.fail("levels", f"{same} is the reference: both intervals would be the same. "
                                      "Leave it out, or use catch_trials")
        if design.levels and design.reference > design.levels[0]:
            raise self.fail("reference", "it is above the lowest level: the reference has to be "
                                         "the best condition")
        trials = design.repetitions * (
            len(design.levels) if design.levels else design.staircase.trials)  # type: ignore
        if trials > TRIALS_MAX:
            raise self.fail("repetitions", f"that is {trials} trials for each participant; at most "
                                           f"{TRIALS_MAX} are played")
        if design.staircase and design.catch_trials > (
                design.repetitions // design.blocks * design.staircase.reversals):
            raise self.fail("catch_trials", "more than the reversals of a block: write fewer")


def _staircase(reader: _Reader, unit: str, reference: float) -> Staircase:
    def level(value: Any) -> float:
        return quantity.parse(value, unit)

    def step_size(value: Any) -> float:
        size = level(value)
        if size <= 0.0:
            raise ValueError("a step has to be more than nothing")
        return size

    start, step = reader.take("start", None, level), reader.take("step", None, step_size)
    for key, value in (("start", start), ("step", step)):
        if value is None:
            example = quantity.EXAMPLES[unit]
            raise reader.fail(key, f"it is missing: write {{ start = …, step = {example} }}")
    top = 100.0 if unit == "%" else max(2.0 * start, start + 4.0 * step)
    staircase = Staircase(
        start=start,
        step=step,
        down=reader.take("down", 2, _a_count(1, 10)),
        up=reader.take("up", 1, _a_count(1, 10)),
        reversals=reader.take("reversals", 8, _a_count(2, 100)),
        lowest=reader.take("lowest", reference, level),
        highest=reader.take("highest", top, level),
        trials=reader.take("trials", 200, _a_count(4, 1000)),
    )
    if not staircase.lowest < staircase.highest:
        raise reader.fail("highest", "it has to lie above the lowest level")
    if not staircase.lowest <= start <= staircase.highest:
        raise reader.fail("start", "it has to lie between lowest and highest")
    return staircase


def _observer(reader: Optional[_Reader], unit: str) -> Optional[Observer]:
    if reader is None:
        return None

    def level(value: Any) -> float:
        found = quantity.parse(value, unit)
        if found <= 0.0:
            raise ValueError("it has to be more than nothing")
        return found

    threshold = reader.take("threshold", None, level)
    if threshold is None:
        raise reader.fail("threshold", f"it is missing: write one, as {quantity.EXAMPLES[unit]}")
    observer = Observer(
        threshold=threshold,
        slope=reader.take("slope", 4.0, _a_number(0.1, 100.0)),
        lapse=reader.take("lapse", 0.0, lambda value: quantity.parse(value, "%") / 100.0),
    )
    return observer


def _a_table(value: Any) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise ValueError(f"{value!r} is no table: write {{ key = value, … }}")
    return value


def _a_text(value: Any) -> str:
    if not isinstance(value, str) or not value.strip():
        raise ValueError(f"{value!r} is no text: write it in quotes")
    if len(value) > 1000 or any(ord(letter) < 32 or ord(letter) == 127 for letter in value):
        raise ValueError("write a single line of at most 1000 characters")
    return value


def _a_flag(value: Any) -> bool:
    if not isinstance(value, bool):
        raise ValueError(f"{value!r}: write true or false")
    return value


def _one_of(*words: str) -> Callable[[Any], str]:
    def read(value: Any) -> str:
        if value not in words:
            raise ValueError(f"{value!r} is unknown: use {', '.join(words)}")
        return str(value)

    return read


def _a_count(least: int, most: int) -> Callable[[Any], int]:
    def read(value: Any) -> int:
        if isinstance(value, bool) or not isinstance(value, int) or not least <= value <= most:
            raise ValueError(f"{value!r}: write a whole number from {least} to {most}")
        return value

    return read


def _a_number(least: float, most: float) -> Callable[[Any], float]:
    def read(value: Any) -> float:
        is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
        if not is_number or not least <= value <= most:
            raise ValueError(f"{value!r}: write a number from {least:g} to {most:g}")
        return float(value)

    return read


def _a_time(least_s: float, most_s: float) -> Callable[[Any], float]:
    def read(value: Any) -> float:
        seconds = quantity.parse(value, "ms") / 1e3
        if not least_s <= seconds <= most_s:
            raise ValueError(f"{value!r}: write a time from {least_s:g}s to {most_s:g}s")
        return seconds

    return read


def _a_factor(value: Any) -> str:
    way, _, name = _a_text(value).rpartition(".")
    way = way or "both"
    if way not in WAYS or name not in FACTORS:
        names = [f"both.{one}" for one in FACTORS]
        near = difflib.get_close_matches(f"both.{name}", names, 1)
        cure = f"did you mean '{near[0]}'?" if near else f"use {', '.join(names)}, or up. or down."
        raise ValueError(f"'{value}' is no condition that gets worse as it grows: {cure}")
    return f"{way}.{name}"


def _levels(value: Any, unit: str) -> tuple[float, ...]:
    if not isinstance(value, list) or not 2 <= len(value) <= LEVELS_MAX:
        raise ValueError(f"write a list of 2 to {LEVELS_MAX} levels")
    levels = [quantity.parse(one, unit) for one in value]
    for before, after in zip(levels, levels[1:]):
        if before >= after:
            low, high = quantity.text(before, unit), quantity.text(after, unit)
            raise ValueError(f"{high} comes after {low}: write them ascending, each once")
    return tuple(levels)


def _conditions(value: Any, factor: str) -> tuple[tuple[str, str], ...]:
    """Other settings of the emulator, which hold in every trial: {"both.loss" = "1%"}."""
    found: list[tuple[str, str]] = []

    def walk(table: dict[str, Any], before: str) -> None:
        for key, one in table.items():
            name = f"{before}{key}"
            if isinstance(one, dict):
                walk(one, name + ".")
            elif isinstance(one, str):
                found.append((name if "." in name else f"both.{name}", one))
            else:
                raise ValueError(f"{name} = {one!r}: write the setting as a text, as '\"1%\"'")

    walk(_a_table(value), "")
    for name, _ in found:
        if name.split(".")[-1] == factor.split(".")[1]:
            raise ValueError(f"{name} is the factor: it cannot hold in every trial, too")
    return tuple(found)
