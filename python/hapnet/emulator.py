# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""hapnet-emulator: a bad network between two programs, or before a server."""

from __future__ import annotations

from typing import Any, Dict, Mapping, Optional, Tuple

from hapnet.control import Reply
from hapnet.process import Daemon, option_words

Address = Tuple[str, int]


def address_of(text: str) -> Address:
    """("127.0.0.1", 7001) of "127.0.0.1:7001", ("::1", 7001) of "[::1]:7001"."""
    host, _, port = text.rpartition(":")
    return host.strip("[]"), int(port)


class Emulator(Daemon):
    """A relay for UDP.

    Before a server: `Emulator(upstream="127.0.0.1:7000", delay="40ms")`; clients send to
    `address`. Between two: `Emulator(a="10.0.0.1:7000", b="10.0.0.2:7000", ...)`, or without `a`
    and `b` between the first two on this machine; they send to `address_a` and `address_b`. Ports
    that are not given are free ones.

    All other keywords are options of the program, with their units in text: `loss="2%"`,
    `seed=7`, `profile="lte"`, `up_delay="80ms"` for --up.delay; `options` are words as on the
    command line.
    """

    program = "hapnet-emulator"

    def __init__(
        self,
        *,
        upstream: Optional[str] = None,
        listen: str = "127.0.0.1:0",
        listen_a: str = "127.0.0.1:0",
        listen_b: str = "127.0.0.1:0",
        options: Tuple[str, ...] = (),
        start_within: float = 10.0,
        **conditions: Any,
    ) -> None:
        if upstream is not None:
            words = ["--listen", listen, "--upstream", upstream]
        elif "link" in conditions:
            words = []
        else:
            words = ["--listen-a", listen_a, "--listen-b", listen_b]
        super().__init__([*words, *option_words(conditions), *options], start_within)

    @property
    def address(self) -> Address:
        """Where clients of `upstream` send to."""
        return address_of(self.ready["listen"])

    @property
    def address_a(self) -> Address:
        """Where A sends to."""
        return address_of(self.ready["a"])

    @property
    def address_b(self) -> Address:
        """Where B sends to."""
        return address_of(self.ready["b"])

    def set(
        self,
        *,
        for_: Optional[str] = None,
        flow: Optional[str] = None,
        regime: Optional[str] = None,
        files: Optional[Mapping[str, str]] = None,
        **settings: str,
    ) -> Reply:
        """Changes conditions from the next datagram on: `set(loss="5%", up_delay="80ms")`, or
        those of a flow: `set(flow="voice", up_delay="80ms")`, or of a regime: `set(regime="bad",
        up_delay="80ms")`. With `for_="2s"` they end by themselves. `files`: the texts of
        files that laws name, by these names, 1 MiB together at most. The reply says from which
        datagram on they hold."""
        before = "" if flow is None else f"flow.{flow}."

        def full(key: str) -> str:
            way, dot, name = key.rpartition(".")
            of = "" if regime is None else f"regime.{regime}."
            return f"{before}{way}{dot}{of}{name}"

        members: Dict[str, Any] = {
            "settings": {full(key_of(key)): str(value) for key, value in settings.items()}
        }
        if for_ is not None:
            members["for"] = for_
        if files is not None:
            members["files"] = dict(files)
        return self.control.request("set", **members)

    def apply(
        self,
        *,
        preset: Optional[str] = None,
        profile: Optional[str] = None,
        files: Optional[Mapping[str, str]] = None,
    ) -> Reply:
        """Replaces the profile: by a built-in one, or by the text of one in TOML. `files`: the
        texts of files that it names, by these names, 1 MiB together at most."""
        if (preset is None) == (profile is None):
            raise ValueError("either preset or profile")
        if preset is not None:
            return self.control.request("apply", preset=preset)
        members: Dict[str, Any] = {"profile": profile, "file": "profile.toml"}
        if files is not None:
            members["files"] = dict(files)
        return self.control.request("apply", **members)

    def reset(self) -> Reply:
        """Back to the profile of the start."""
        return self.control.request("reset")


def key_of(keyword: str) -> str:
    """The key of a setting: up.delay of up_delay, both.loss of loss, down.burst_loss of
    down_burst_loss."""
    way, _, rest = keyword.partition("_")
    if rest and way in ("up", "down", "both"):
        return f"{way}.{rest}"
    return keyword if "." in keyword else f"both.{keyword}"
