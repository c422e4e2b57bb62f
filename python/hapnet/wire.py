# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""The messages between peers (docs/formats/wire.md), version 2: for programs that join a session.

Times are nanoseconds of the sender's CLOCK_BOOTTIME, vectors tuples (x, y, z) in SI units. Sealed
messages are not read here: the daemon on the other side runs without keys, on loopback or with
--insecure.
"""

from __future__ import annotations

import math
import struct
from dataclasses import dataclass, field, replace
from typing import List, Optional, Tuple, Union

Vector = Tuple[float, float, float]
Sums = Tuple[int, int, int]

MAGIC, VERSION = 0x4E48, 2
HELLO, STATE, BYE = 1, 2, 3
BODIES_MAX = 8
TIME_MAX = 1 << 60
ZERO: Vector = (0.0, 0.0, 0.0)

_HEADER = struct.Struct("<HBBI")
_HELLO = struct.Struct("<BIIHHQQqqIqq16sIII4f")
_STATE = struct.Struct("<IqBBqI3f3f3f3h3hI")
_BODY = struct.Struct("<H3f3f3I3I")
_TURNING = struct.Struct("<Q3f3I3I")
_BYE = struct.Struct("<B")

INTENTION_STEP, INTENTION_VELOCITY_STEP = 1e-5, 2e-4


class Malformed(ValueError):
    """The bytes are no message of this version."""


@dataclass(frozen=True)
class Echo:
    """When a message of the other side had reached the sender."""

    of: int  # its `sent`
    age: int  # ns from its arrival to the message that carries the echo


@dataclass(frozen=True)
class Hello:
    nonce: int  # of this run, not 0
    peer_id: int
    task: str
    scene_hash: int
    sent: int = 0
    nonce_heard: int = 0
    tick_rate_hz: int = 1000
    seed: int = 0
    echo: Optional[Echo] = None
    start: Optional[int] = None
    start_heard: Optional[int] = None
    in_session: bool = False
    length_ms: int = 0
    heard: int = 0
    boot: int = 0
    hand: Tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Turning:
    """What is said of a body that can turn, besides. `orientation` is the code of the wire."""

    orientation: int
    angular_velocity: Vector = ZERO
    caused_rotation: Sums = (0, 0, 0)
    caused_angular_impulse: Sums = (0, 0, 0)


@dataclass(frozen=True)
class Body:
    body: int = 0
    position: Vector = ZERO
    velocity: Vector = ZERO
    caused_displacement: Sums = (0, 0, 0)  # micrometres, modulo 2**32
    caused_impulse: Sums = (0, 0, 0)  # micronewton seconds, modulo 2**32
    turning: Optional[Turning] = None


@dataclass(frozen=True)
class State:
    session: int
    sequence: int
    sent: int
    echo: Optional[Echo] = None
    touching: bool = False
    holding: bool = False
    hip: Vector = ZERO
    hip_velocity: Vector = ZERO
    contact_force: Vector = ZERO
    intention: Vector = ZERO  # from the HIP
    intention_velocity: Vector = ZERO
    work_uj: int = 0
    bodies: List[Body] = field(default_factory=list)


@dataclass(frozen=True)
class Bye:
    session: int = 0
    reason: int = 0


Message = Union[Hello, State, Bye]


def session_number(low_nonce: int, high_nonce: int) -> int:
    """The number of the session of two runs: the nonce of the peer with the lower id first."""
    mixed = low_nonce << 32 | high_nonce
    mixed ^= mixed >> 31
    mixed = mixed * 0xBF58476D1CE4E5B9 % (1 << 64)
    mixed ^= mixed >> 27
    mixed = mixed * 0x94D049BB133111EB % (1 << 64)
    return mixed >> 32 or 1


def _steps(vector: Vector, step: float) -> Tuple[int, ...]:
    return tuple(max(-32767, min(32767, round(one / step))) for one in vector)


def encode(message: Message) -> bytes:
    """The bytes of a message. Raises struct.error for a number that does not fit."""
    if isinstance(message, Hello):
        return _encode_hello(message)
    if isinstance(message, State):
        return _encode_state(message)
    return _HEADER.pack(MAGIC, VERSION, BYE, message.session) + _BYE.pack(message.reason)


def _encode_hello(m: Hello) -> bytes:
    flags = (
        (1 if m.echo else 0)
        | (2 if m.start is not None else 0)
        | (4 if m.start_heard is not None else 0)
        | (8 if m.in_session else 0)
    )
    echo = m.echo or Echo(0, 0)
    times = (m.sent, echo.of, echo.age, m.start or 0, m.start_heard or 0)
    return _HEADER.pack(MAGIC, VERSION, HELLO, 0) + _HELLO.pack(
        flags, m.nonce, m.nonce_heard, m.peer_id, m.tick_rate_hz, m.scene_hash, m.seed, *times,
        m.task.encode("ascii"), m.length_ms, m.heard, m.boot, *m.hand,
    )  # fmt: skip


def _encode_state(m: State) -> bytes:
    flags = (
        (1 if m.echo else 0)
        | (2 if m.touching else 0)
        | (4 if m.holding else 0)
        | (8 if m.bodies else 0)
    )
    echo = m.echo or Echo(0, 0)
    parts = [
        _HEADER.pack(MAGIC, VERSION, STATE, m.session),
        _STATE.pack(
            m.sequence, m.sent, flags, 0, echo.of, echo.age, *m.hip, *m.hip_velocity,
            *m.contact_force, *_steps(m.intention, INTENTION_STEP),
            *_steps(m.intention_velocity, INTENTION_VELOCITY_STEP), m.work_uj,
        ),
    ]  # fmt: skip
    for b in m.bodies:
        number = b.body | (0x8000 if b.turning else 0)
        parts.append(
            _BODY.pack(number, *b.position, *b.velocity, *b.caused_displacement, *b.caused_impulse)
        )
        if b.turning:
            t = b.turning
            parts.append(
                _TURNING.pack(t.orientation, *t.angular_velocity, *t.caused_rotation,
                              *t.caused_angular_impulse)
            )  # fmt: skip
    return b"".join(parts)


def decode(datagram: bytes) -> Message:
    """The message in a datagram. Raises Malformed unless its bytes are canonical: a message that is
    accepted encodes to the same bytes."""
    try:
        message = _decode(datagram)
        canonical = encode(message) == datagram
    except (struct.error, UnicodeDecodeError, OverflowError) as wrong:
        raise Malformed(str(wrong)) from None
    if not canonical:
        raise Malformed("not canonical")
    return message


def _decode(datagram: bytes) -> Message:
    if len(datagram) < _HEADER.size:
        raise Malformed("too short")
    magic, version, kind, session = _HEADER.unpack_from(datagram)
    if magic != MAGIC or version != VERSION:
        raise Malformed("not a message of version 2")
    body = datagram[_HEADER.size :]
    if kind == HELLO and session == 0:
        return _decode_hello(body)
    if kind == STATE:
        return _decode_state(body, session)
    if kind == BYE:
        (reason,) = _BYE.unpack(body)
        if reason <= 6:
            return Bye(session, reason)
    raise Malformed("an unknown kind of message")


def _echo(flags: int, of: int, age: int) -> Optional[Echo]:
    return Echo(of, age) if flags & 1 else None


def _check(numbers: Tuple[float, ...], times: Tuple[int, ...]) -> None:
    if not all(map(math.isfinite, numbers)):
        raise Malformed("not finite")
    if any(abs(time) > TIME_MAX for time in times):
        raise Malformed("a time out of range")


def _decode_hello(body: bytes) -> Hello:
    v = _HELLO.unpack(body)
    flags, nonce, nonce_heard, peer_id, rate, scene_hash, seed, sent, of, age, start, heard = v[:12]
    _check(v[16:20], (sent, of, start, heard))
    task = v[12].rstrip(b"\0").decode("ascii")
    if flags > 15 or nonce == 0 or peer_id == 0 or rate == 0 or not task:
        raise Malformed("a value that is not allowed")
    if any(not "!" <= letter <= "~" for letter in task) or min(v[16:20]) < 0.0:
        raise Malformed("a value that is not allowed")
    return Hello(
        nonce=nonce, peer_id=peer_id, task=task, scene_hash=scene_hash, sent=sent,
        nonce_heard=nonce_heard, tick_rate_hz=rate, seed=seed, echo=_echo(flags, of, age),
        start=start if flags & 2 else None, start_heard=heard if flags & 4 else None,
        in_session=bool(flags & 8), length_ms=v[13], heard=v[14], boot=v[15], hand=v[16:20],
    )  # fmt: skip


def _vector(numbers: Tuple[float, ...], step: float = 1.0) -> Vector:
    return (numbers[0] * step, numbers[1] * step, numbers[2] * step)


def _decode_state(data: bytes, session: int) -> State:
    v = _STATE.unpack_from(data)
    sequence, sent, flags, _, of, age = v[:6]
    _check(v[6:15], (sent, of))
    if flags > 15 or sequence == 0 or flags & 6 == 4 or min(v[15:21]) < -32767:
        raise Malformed("a value that is not allowed")
    state = State(
        session=session, sequence=sequence, sent=sent, echo=_echo(flags, of, age),
        touching=bool(flags & 2), holding=bool(flags & 4), hip=v[6:9], hip_velocity=v[9:12],
        contact_force=v[12:15], intention=_vector(v[15:18], INTENTION_STEP),
        intention_velocity=_vector(v[18:21], INTENTION_VELOCITY_STEP), work_uj=v[21],
    )  # fmt: skip
    bodies: List[Body] = []
    at = _STATE.size
    while at < len(data):
        b = _BODY.unpack_from(data, at)
        at += _BODY.size
        _check(b[1:7], ())
        body = Body(b[0] & 0x7FFF, b[1:4], b[4:7], b[7:10], b[10:13])
        if b[0] & 0x8000:
            t = _TURNING.unpack_from(data, at)
            at += _TURNING.size
            _check(t[1:4], ())
            body = replace(body, turning=Turning(t[0], t[1:4], t[4:7], t[7:10]))
        if bodies and bodies[-1].body >= body.body:
            raise Malformed("bodies out of order")
        bodies.append(body)
    if len(bodies) > BODIES_MAX or bool(bodies) != bool(flags & 8):
        raise Malformed("another number of bodies than said")
    return replace(state, bodies=bodies)
