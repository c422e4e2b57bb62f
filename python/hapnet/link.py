# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""A bad network inside your own program: no thread, no socket, no clock.

    with Link("lte", seed=1) as link:
        link.push(UP, b"hello", now=0.0)
        while (packet := link.pop(now=0.2)) is not None:
            print(packet.direction, packet.due - packet.arrived)

It calls the shared library of the emulator (hapnet_link.h). Equal profiles, seeds, packets and
times give equal fates, here and in the daemon."""

from __future__ import annotations

import ctypes
import ctypes.util
import json
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable, Dict, Optional

LIBRARY = "libhapnet-link.so.0"
UP, DOWN = "up", "down"
PACKET_MAX = 65507
_WAYS = (UP, DOWN)
_NEVER = 2**63 - 1
_TEXT_BYTES = 4096


class LinkRefused(ValueError):
    """A profile, a setting or a packet that the link does not take, and why."""


@dataclass(frozen=True)
class Packet:
    """A packet that has left. Times in seconds since the link began."""

    direction: str
    """UP or DOWN."""
    data: bytes
    number: int
    """Number of the packet in its direction, from 0. A copy has the number of its original."""
    arrived: float
    due: float
    is_copy: bool


class _Described(ctypes.Structure):
    _fields_ = [
        ("number", ctypes.c_uint64),
        ("arrived_ns", ctypes.c_int64),
        ("due_ns", ctypes.c_int64),
        ("size", ctypes.c_size_t),
        ("direction", ctypes.c_int),
        ("is_copy", ctypes.c_int),
    ]


def _found() -> str:
    """The path of the library: beside the programs of HAPNET_BIN, or where the system has it."""
    folder = os.environ.get("HAPNET_BIN")
    if folder:
        for beside in (Path(folder).parent / "lib", Path(folder)):
            if (beside / LIBRARY).exists():
                return str(beside / LIBRARY)
    return LIBRARY


def _loaded() -> ctypes.CDLL:
    path = _found()
    try:
        library = ctypes.CDLL(path)
    except OSError as trouble:
        raise LinkRefused(
            f"{LIBRARY} cannot be loaded ({trouble}): install the package libhapnet-link0, or set "
            "HAPNET_BIN to the folder of the programs that were built"
        ) from trouble
    pointer, text, size, time = ctypes.c_void_p, ctypes.c_char_p, ctypes.c_size_t, ctypes.c_int64
    buffer = ctypes.c_char_p
    described = ctypes.POINTER(_Described)
    for name, result, arguments in (
        ("create", pointer, [text, ctypes.c_uint64, buffer, size]),
        ("create_in", pointer, [text, text, ctypes.c_uint64, buffer, size]),
        ("destroy", None, [pointer]),
        ("set", ctypes.c_int, [pointer, text, text, time, buffer, size]),
        ("push", ctypes.c_int, [pointer, ctypes.c_int, text, size, time]),
        ("pop", ctypes.c_int, [pointer, time, buffer, size, described]),
        ("next_deadline", time, [pointer]),
        ("statistics", size, [pointer, buffer, size]),
        ("fate", size, [pointer, buffer, size]),
        ("cause", text, [ctypes.c_int]),
    ):
        function = getattr(library, f"hapnet_link_{name}")
        function.restype = result
        function.argtypes = arguments
    return library


def _ns(seconds: float) -> int:
    return round(seconds * 1e9)


class Link:
    """An emulated path in both directions. Use it from one thread at a time.

    `profile`: a profile as text, or the name of a preset. `folder`: where the files are that the
    profile names; None: it may name none. LinkRefused says what is wrong with it. Times are seconds
    since the link began. A time before that of the last call counts as that time."""

    def __init__(self, profile: str, seed: int = 1, folder: Optional[str] = None) -> None:
        self._library = _loaded()
        self._buffer = ctypes.create_string_buffer(PACKET_MAX)
        error = ctypes.create_string_buffer(_TEXT_BYTES)
        where = [] if folder is None else [os.fsencode(folder)]
        create = self._library.hapnet_link_create_in if where else self._library.hapnet_link_create
        self._link: Optional[int] = create(profile.encode(), *where, seed, error, len(error))
        if not self._link:
            raise LinkRefused(error.value.decode())

    def __enter__(self) -> "Link":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __del__(self) -> None:
        if getattr(self, "_link", None):
            self.close()

    def close(self) -> None:
        """Frees the link, and what is in flight on it."""
        self._library.hapnet_link_destroy(self._link)
        self._link = None

    def set(self, key: str, value: str, now: float) -> None:
        """Sets one condition for what is pushed from `now` on: `set("up.delay", "200ms", 3.0)`."""
        error = ctypes.create_string_buffer(_TEXT_BYTES)
        done = self._library.hapnet_link_set(self._open(), key.encode(), value.encode(), _ns(now),
                                             error, len(error))
        if done != 0:
            raise LinkRefused(error.value.decode())

    def push(self, direction: str, data: bytes, now: float) -> Optional[str]:
        """Takes a packet that arrives at `now`. Returns the reason why it is dropped, such as
        "random_loss"; None: it will leave."""
        cause: int = self._library.hapnet_link_push(self._open(), _WAYS.index(direction), data,
                                                    len(data), _ns(now))
        if cause < 0:
            raise LinkRefused(f"a packet has at most {PACKET_MAX} bytes, not {len(data)}")
        return self._library.hapnet_link_cause(cause).decode() if cause else None

    def pop(self, now: float) -> Optional[Packet]:
        """The packet that is due at `now`, the earliest first; None without one."""
        about = _Described()
        if self._library.hapnet_link_pop(self._open(), _ns(now), self._buffer, PACKET_MAX,
                                         ctypes.byref(about)) != 1:
            return None
        data = ctypes.string_at(self._buffer, about.size)
        return Packet(_WAYS[about.direction], data, about.number, about.arrived_ns / 1e9,
                      about.due_ns / 1e9, bool(about.is_copy))

    def next_deadline(self) -> Optional[float]:
        """When to call pop() again; None while nothing is in flight."""
        deadline: int = self._library.hapnet_link_next_deadline(self._open())
        return None if deadline == _NEVER else deadline / 1e9

    def statistics(self) -> Dict[str, Any]:
        """Both directions, with the keys of docs/formats/statistics.md."""
        found: Dict[str, Any] = json.loads(self._text(self._library.hapnet_link_statistics))
        return found

    def last_fate(self) -> str:
        """The fate of the packet that was pushed last: a line of docs/formats/fates.md."""
        return self._text(self._library.hapnet_link_fate)

    def _open(self) -> int:
        if self._link is None:
            raise LinkRefused("this link is closed")
        return self._link

    def _text(self, function: Callable[..., int]) -> str:
        size = function(self._open(), None, 0)
        buffer = ctypes.create_string_buffer(size + 1)
        function(self._open(), buffer, len(buffer))
        return buffer.value.decode()
