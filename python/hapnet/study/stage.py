# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Plays the intervals of a trial: two peers through an emulator, on this machine. The condition is
in no file name and in nothing that is printed."""

from __future__ import annotations

import hashlib
import os
import time
from dataclasses import dataclass, field
from typing import Any, Callable, Optional, Sequence

from hapnet.emulator import Emulator
from hapnet.lab import Lab
from hapnet.peer import Peer
from hapnet.process import ProgramFailed, run
from hapnet.study.design import Design, DesignError
from hapnet.study.plan import Trial

LATER_S = 30.0  # extra time of a session beyond its duration
EVERY_S = 0.05


class EmergencyStop(Exception):
    """A person has ended the force while an interval was played."""


@dataclass
class Played:
    """The results of a trial that was played."""

    records: list[str] = field(default_factory=list)
    """Names of files, in the participant's folder."""
    discrepancy_mm: list[Optional[float]] = field(default_factory=list)
    """Mean distance of the two copies of the body, of each interval."""
    invalid_because: list[str] = field(default_factory=list)


def levels_of(design: Design, trial: Trial) -> list[float]:
    """The level of each interval."""
    if not design.two_intervals:
        return [trial.level]
    return [trial.level if trial.worse == one else design.reference for one in (1, 2)]


def verify(design: Design) -> None:
    """Has the programs check the settings of a design that they use. Raises DesignError, which
    names the key, and ProgramFailed if a program is missing."""
    settings = [f"--set={key}={value}" for key, value in design.conditions]
    factor = f"--set={design.factor}={design.level_text(design.highest)}"
    for key, program, words in (
        ("conditions", "hapnet-emulator", ["check", *settings, factor]),
        ("algorithm", "hapnet-peer", ["--print-algorithm", design.algorithm]),
        ("scene", "hapnet-lab", ["explain", design.scene]),
    ):
        is_shared_object = key == "algorithm" and design.algorithm.endswith(".so")
        if is_shared_object or (key == "scene" and design.scene is None):
            continue  # a shared object is judged by the peer that loads it
        try:
            run(program, [word for word in words if word], 60.0)
        except ProgramFailed as refused:
            if refused.code is None:
                raise
            raise DesignError(f"{design.file}: {key}: {refused}") from None


class Stage:
    """Where trials are played. `device` and `partner` are what --device of hapnet-peer takes, for
    the participant's hand (A) and the other one (B); `words` are further options of the
    participant's peer."""

    def __init__(self, design: Design, participant: int, device: Optional[str] = None,
                 partner: Optional[str] = None, words: Sequence[str] = ()) -> None:
        self._design, self._participant = design, participant
        self._device, self._partner, self._words = device, partner, tuple(words)

    def play(self, trial: Trial, folder: str, say: Callable[[str], None],
             is_stopped: Callable[[], bool]) -> Played:
        """Plays the intervals. `is_stopped` is asked all the time: once it says so, the force ends
        at once, and EmergencyStop is raised. Raises ProgramFailed."""
        played = Played()
        levels = levels_of(self._design, trial)
        for interval, level in enumerate(levels, 1):
            if len(levels) > 1:
                say(f"interval {interval} of 2")
            stem = os.path.join(folder, f"trial-{trial.number:04d}-{interval}")
            self._session(trial, level, stem, is_stopped, played)
        return played

    def _session(self, trial: Trial, level: float, stem: str, is_stopped: Callable[[], bool],
                 played: Played) -> None:
        design = self._design
        seed = seed_of(design, self._participant, trial)
        settings = [f"{key}={value}" for key, value in design.conditions]
        settings.append(f"{design.factor}={design.level_text(level)}")
        records = [f"{stem}-{side}.rec" for side in "ab"]
        common: dict[str, Any] = {
            "task": design.task, "algorithm": design.algorithm, "scene": design.scene,
            "duration": f"{round(design.duration_s * 1e3)}ms",
        }
        with Emulator(seed=seed, set=settings) as network:
            a = Peer(id=1, remote="%s:%d" % network.address_a, seed=seed, record=records[0],
                     device=self._device, options=self._words, **common)
            b = Peer(id=2, remote="%s:%d" % network.address_b, seed=seed, record=records[1],
                     device=self._partner, **common)
            with a, b:
                self._await_end((a, b), is_stopped)
                a.join(LATER_S)
                b.join(LATER_S)
            stats = network.stats()
        for side in ("up", "down"):
            why = stats[side].get("invalid_because", [])
            played.invalid_because += [f"emulator {side}: {one}" for one in why]
        analysis = Lab(timeout=60.0).analyse(*records)
        played.invalid_because += analysis["invalid_because"]
        played.records += [os.path.basename(one) for one in records]
        played.discrepancy_mm.append((analysis.get("discrepancy_x_mm") or {}).get("mean"))

    def _await_end(self, peers: tuple[Peer, Peer], is_stopped: Callable[[], bool]) -> None:
        end = time.monotonic() + self._design.duration_s + LATER_S
        while all(peer.is_running() for peer in peers):
            if is_stopped():
                for peer in peers:
                    peer.emergency_stop()
                raise EmergencyStop
            if time.monotonic() > end:
                raise ProgramFailed("the session did not end in time: hapnet-peer doctor says what "
                                    "this machine lacks")
            time.sleep(EVERY_S)


def seed_of(design: Design, participant: int, trial: Trial) -> int:
    """The seed of a trial: the same in both intervals, so that they differ by the level alone."""
    words = f"hapnet-study/{design.seed}/{participant}/{trial.number}".encode()
    return int.from_bytes(hashlib.sha256(words).digest()[:4], "big")
