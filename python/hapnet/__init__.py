# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Drive Hapnet's programs from Python, and read what they write.

Needs the programs (in PATH, or in the folder that the environment variable HAPNET_BIN names) and
nothing but Python's standard library. docs/use/python.md has examples.
"""

from hapnet.control import ControlSocket, Refused
from hapnet.emulator import Emulator
from hapnet.lab import Lab
from hapnet.peer import Peer
from hapnet.process import ProgramFailed
from hapnet.record import Record, read_record
from hapnet.results import read_csv, read_manifest, to_frame

__version__ = "0.2.0"

__all__ = [
    "ControlSocket",
    "Emulator",
    "Lab",
    "Peer",
    "ProgramFailed",
    "Record",
    "Refused",
    "read_csv",
    "read_manifest",
    "read_record",
    "to_frame",
]
