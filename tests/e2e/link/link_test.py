#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""The link of the shared library against the daemon: equal fates, byte for byte, under every law
that does not ask for the time. A million datagrams in all with HAPNET_LINK_PACKETS=60000."""

import os
import socket
import sys
import tempfile
import time
from pathlib import Path

from hapnet.emulator import Emulator
from hapnet.link import UP, Link

PACKET = bytes(96)
BATCH = 200
LAWS = (
    'delay = { law = "uniform", mean = "9ms", half_width = "5ms" }',
    'delay = { law = "normal", mean = "20ms", sd = "5ms" }',
    'delay = { law = "exponential", mean = "5ms" }',
    'delay = { law = "gamma", mean = "10ms", sd = "5ms" }',
    'delay = { law = "log-normal", mean = "10ms", sd = "5ms" }',
    'delay = { law = "pareto", mean = "5ms" }',
    'jitter = "5ms"\ndelay = "9ms"\norder = "sorted"',
    'loss = "2%"',
    'loss = { law = "k-of-n", lost = 5, of = 100 }',
    'loss = { law = "every", every = 100 }',
    'loss = { law = "burst", lost = 40, of = 100 }',
    'loss = { law = "gilbert", share = "2%", mean_burst = 5.0 }',
    'loss = { law = "gilbert-elliott", good_to_bad = "1%", bad_to_good = "25%" }',
    'loss = { law = "four-state", share = "2%", burst = 8.0, density = "80%", isolated = "0.1%" }',
    'loss = [{ law = "list", numbers = [3, 17] }, { law = "pattern", pattern = "0001" }]',
    'corrupt = { share = "5%", bits = 3 }\nduplicate = { share = "5%", spread = "3ms" }',
    'reorder = { share = "5%", displacement = 3 }',
)


def fates_of_daemon(profile: Path, fates: Path, packets: int) -> str:
    """The rows of what the daemon wrote about so many datagrams, as far as they came."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sink, socket.socket(
        socket.AF_INET, socket.SOCK_DGRAM
    ) as source:
        sink.bind(("127.0.0.1", 0))
        source.bind(("127.0.0.1", 0))
        with Emulator(a=f"127.0.0.1:{source.getsockname()[1]}", profile=str(profile), seed=42,
                      b=f"127.0.0.1:{sink.getsockname()[1]}", fates=str(fates)) as emulator:
            for number in range(packets):
                source.sendto(PACKET, emulator.address_a)
                if number % BATCH == 0:
                    time.sleep(0.002)  # the receiving socket holds so many
            time.sleep(0.1)
    return fates.read_text(encoding="ascii").partition("\n")[2]


def fates_of_link(text: str, packets: int) -> str:
    """The same of a link in this process."""
    rows = []
    with Link(text, seed=42) as link:
        for number in range(packets):
            link.push(UP, PACKET, number * 1e-3)
            rows.append(link.last_fate())
            while link.pop(number * 1e-3) is not None:
                pass
    return "".join(rows)


def main() -> int:
    packets = int(os.environ.get("HAPNET_LINK_PACKETS", "3000"))
    differ = 0
    with tempfile.TemporaryDirectory(prefix="hapnet-link-") as name:
        for number, law in enumerate(LAWS):
            profile = Path(name) / f"{number}.toml"
            text = f"[up]\n{law}\n"
            profile.write_text(text, encoding="ascii")
            daemon = fates_of_daemon(profile, Path(name) / f"{number}.csv", packets)
            rows = daemon.count("\n")
            same = rows > packets // 2 and fates_of_link(text, rows) == daemon
            differ += not same
            if not same:
                print(f"{law}: the fates of {rows} datagrams differ")
    print(f"{len(LAWS)} laws, {differ} differ")
    return 1 if differ else 0


if __name__ == "__main__":
    sys.exit(main())
