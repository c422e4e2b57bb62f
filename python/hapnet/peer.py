# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""hapnet-peer: one side of a session."""

from __future__ import annotations

from typing import Any, Tuple

from hapnet.emulator import Address, address_of
from hapnet.process import Daemon, option_words


class Peer(Daemon):
    """A peer with a simulated hand, or with the device that `device` names:
    `Peer(id=1, remote="127.0.0.1:7002", task="T3", record="a.rec")`. Keywords are the options of
    the program with _ for -, and `options` words as on the command line. It ends by itself after
    `duration`: see join().
    """

    program = "hapnet-peer"

    def __init__(
        self, *, options: Tuple[str, ...] = (), start_within: float = 10.0, **keywords: Any
    ) -> None:
        super().__init__([*option_words(keywords), *options], start_within)

    @property
    def address(self) -> Address:
        """Where it listens."""
        return address_of(self.ready["listen"])

    def emergency_stop(self) -> None:
        """Zero force until it is started anew. The session goes on without."""
        self.control.request("estop")
