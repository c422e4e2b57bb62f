# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""One side of a session between two, without socket, device or scene: who the other is, when the
session starts, and the frame of each message. docs/formats/wire.md has the rules."""

from __future__ import annotations

import secrets
import time
from typing import Any, Optional

from hapnet.wire import Bye, Echo, Hello, Malformed, State, decode, encode, session_number

HELLO_EVERY = 20_000_000
START_AFTER = 1_000_000_000
ECHO_AGE_MAX = (1 << 32) - 1


def boot_time() -> int:
    """Nanoseconds of the clock that all of Hapnet's messages and records use."""
    return time.clock_gettime_ns(time.CLOCK_BOOTTIME)


class Session:
    """Feed hear() with what arrives, drain hello(), and send state() each tick from `start` on."""

    def __init__(
        self, peer_id: int, task: str, scene_hash: Optional[int] = None, length_s: float = 30.0
    ) -> None:
        """`scene_hash` as the daemon has it in its statistics; None: whatever the other plays in,
        which this side then has to know. None also leaves the first word to the other side."""
        self.nonce = secrets.randbits(32) or 1
        self.peer_id, self.task, self.scene_hash = peer_id, task, scene_hash
        self.length_ns = round(length_s * 1e9)
        self.other: Optional[Hello] = None
        """The newest hello of the other side."""
        self.start: Optional[int] = None
        """When the session starts, on the clock of this side."""
        self.heard: Optional[State] = None
        """The newest state of the other side."""
        self.heard_at = 0
        self.states_heard = 0
        self.is_over = False
        """The other side said goodbye, or refused."""
        self.refused: Optional[int] = None
        self._sequence = 0
        self._last_hello: Optional[int] = None
        self._newest: Optional[tuple[int, int]] = None  # sent by them, arrived here
        self._offset = 0  # their clock minus ours, by the shortest round trip
        self._round_trip: Optional[int] = None

    @property
    def number(self) -> int:
        """Of the session, as its messages have it; 0 before the other side was heard."""
        if self.other is None:
            return 0
        if self.peer_id < self.other.peer_id:
            return session_number(self.nonce, self.other.nonce)
        return session_number(self.other.nonce, self.nonce)

    def hear(self, datagram: bytes, arrived: int) -> None:
        """Takes in a datagram. What is malformed, of another session or overtaken is dropped."""
        try:
            message = decode(datagram)
        except Malformed:
            return
        if isinstance(message, Bye):
            if message.reason >= 2 and self.heard is None:
                self.refused, self.is_over = message.reason, True
            elif message.session == self.number != 0:
                self.is_over = True
        elif isinstance(message, Hello):
            self._hear_hello(message, arrived)
        elif message.session == self.number != 0:
            self._hear_echo(message.echo, message.sent, arrived)
            if self.heard is None or message.sequence > self.heard.sequence:
                self.heard, self.heard_at = message, arrived
                self.states_heard += 1

    def hello(self, now: int) -> Optional[bytes]:
        """The hello that is due, if one is."""
        if self.scene_hash is None and self.other is None:
            return None
        settled = self.start is not None and self.heard is not None
        if settled or (self._last_hello is not None and now - self._last_hello < HELLO_EVERY):
            return None
        self._last_hello = now
        hash_said = self.scene_hash
        if hash_said is None and self.other is not None:
            hash_said = self.other.scene_hash
        leads = self.other is not None and self.peer_id < self.other.peer_id
        return encode(
            Hello(
                nonce=self.nonce,
                peer_id=self.peer_id,
                task=self.task,
                scene_hash=hash_said or 0,
                sent=now,
                nonce_heard=self.other.nonce if self.other else 0,
                echo=self._echo(now),
                start=self.start if leads else None,
                start_heard=self.other.start if self.other else None,
                length_ms=self.length_ns // 1_000_000,
            )
        )

    def state(self, now: int, **fields: Any) -> bytes:
        """The state of this tick; `fields` are those of wire.State besides its frame."""
        self._sequence += 1
        return encode(State(self.number, self._sequence, now, self._echo(now), **fields))

    def bye(self) -> bytes:
        """To be sent five times at the end."""
        return encode(Bye(self.number))

    def _hear_hello(self, hello: Hello, arrived: int) -> None:
        if hello.peer_id == self.peer_id:
            return
        if self.other is not None and hello.nonce != self.other.nonce and self.heard is not None:
            return  # another run, while one is in session
        self.other = hello
        self._newest = (hello.sent, arrived)
        if hello.length_ms:
            self.length_ns = min(self.length_ns, hello.length_ms * 1_000_000)
        if hello.nonce_heard != self.nonce:
            return
        self._hear_echo(hello.echo, hello.sent, arrived)
        if self._round_trip is None:
            return
        if hello.start is not None:
            self.start = hello.start - self._offset
        elif self.peer_id < hello.peer_id and self.start is None:
            self.start = arrived + START_AFTER

    def _hear_echo(self, echo: Optional[Echo], sent: int, arrived: int) -> None:
        self._newest = (sent, arrived)
        if echo is None:
            return
        reached = sent - echo.age  # their clock, when ours arrived
        round_trip = (arrived - echo.of) - echo.age
        if round_trip >= 0 and (self._round_trip is None or round_trip < self._round_trip):
            self._round_trip = round_trip
            self._offset = ((reached - echo.of) + (sent - arrived)) // 2

    def _echo(self, now: int) -> Optional[Echo]:
        if self._newest is None or not 0 <= now - self._newest[1] <= ECHO_AGE_MAX:
            return None
        return Echo(self._newest[0], now - self._newest[1])
