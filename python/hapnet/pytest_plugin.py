# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Fixtures of pytest. Where the package is installed they are there; from a clone, name them:
`pytest -p hapnet.pytest_plugin`.

    def test_survives_loss(hapnet_emulator):
        network = hapnet_emulator(upstream="127.0.0.1:7000", loss="5%")
        client = connect(network.address)
"""

from __future__ import annotations

from contextlib import ExitStack
from typing import Any, Callable, Iterator, Type, TypeVar

import pytest

from hapnet.emulator import Emulator
from hapnet.lab import Lab
from hapnet.peer import Peer
from hapnet.process import Daemon

One = TypeVar("One", bound=Daemon)


def _factory(kind: Type[One], stack: ExitStack) -> Callable[..., One]:
    def start(**keywords: Any) -> One:
        return stack.enter_context(kind(**keywords))

    return start


@pytest.fixture
def hapnet_emulator() -> Iterator[Callable[..., Emulator]]:
    """Starts emulators, with the keywords of hapnet.Emulator; all are stopped after the test."""
    with ExitStack() as stack:
        yield _factory(Emulator, stack)


@pytest.fixture
def hapnet_peer() -> Iterator[Callable[..., Peer]]:
    """Starts peers, with the keywords of hapnet.Peer; all are stopped after the test."""
    with ExitStack() as stack:
        yield _factory(Peer, stack)


@pytest.fixture
def hapnet_lab() -> Lab:
    """Runs of hapnet-lab, ten minutes each at most."""
    return Lab(timeout=600.0)
