# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""The control socket of a daemon: one JSON object per line (docs/formats/control.md)."""

from __future__ import annotations

import json
import socket
from typing import Any, Dict, Iterator, Mapping, Optional

Reply = Dict[str, Any]

REPLY_BYTES_MAX = 64 << 20


class Refused(Exception):
    """The daemon refused a request, and nothing has changed. The text says why."""


class ControlSocket:
    """A connection to the Unix socket at `path`. Not for several threads at a time."""

    def __init__(self, path: str, timeout: Optional[float] = 10.0) -> None:
        """`timeout`: seconds to wait for a reply at most, None: without a limit."""
        self._timeout = timeout
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self._socket.settimeout(timeout)
        try:
            self._socket.connect(path)
        except OSError:
            self._socket.close()
            raise
        self._lines = self._socket.makefile("rb")

    def close(self) -> None:
        self._lines.close()
        self._socket.close()

    def __enter__(self) -> "ControlSocket":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def request(self, command: str, **members: Any) -> Reply:
        """Sends a command and returns its reply. Raises Refused with the daemon's reason, and
        ConnectionError when the daemon has closed the connection."""
        self._socket.settimeout(self._timeout)
        return self._exchange({"command": command, **members})

    def wait(self, until: str, timeout: float = 10.0) -> bool:
        """Waits until a condition on the statistics holds, such as "up.received>1000"; False when
        `timeout` seconds (up to a day) have passed before."""
        self._socket.settimeout(None if self._timeout is None else timeout + self._timeout)
        milliseconds = f"{max(0, round(1000 * timeout))}ms"
        reply = self._exchange({"command": "wait", "until": until, "timeout": milliseconds})
        return bool(reply["met"])

    def watch(self, every: float = 0.5) -> Iterator[Reply]:
        """The statistics every so many seconds (0.05 at least), without an end. Another request
        must not be made before the iterator is closed."""
        self._socket.settimeout(None if self._timeout is None else every + self._timeout)
        yield self._exchange({"command": "watch", "every": f"{round(1000 * every)}ms"})
        while True:
            yield self._reply()

    def _exchange(self, request: Mapping[str, Any]) -> Reply:
        self._socket.sendall(json.dumps(request).encode() + b"\n")
        return self._reply()

    def _reply(self) -> Reply:
        line = self._lines.readline(REPLY_BYTES_MAX)
        if not line.endswith(b"\n"):
            raise ConnectionError("the daemon closed its control socket")
        reply: Reply = json.loads(line)
        if not reply.get("ok", False):
            raise Refused(str(reply.get("error", reply)))
        return reply
