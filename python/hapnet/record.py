# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Records of sessions (docs/formats/record.md): read by the description in their own header."""

from __future__ import annotations

import difflib
import json
import struct
from dataclasses import dataclass, field
from typing import Any, Dict, List, Optional, Sequence, Tuple

Value = Any
HEADER_BYTES_MAX = 1 << 20
VERSIONS = (2, 3, 4, 5)

_LETTERS = {"u8": "B", "u16": "H", "u32": "I", "u64": "Q", "i64": "q", "f64": "d", "bool": "?"}


@dataclass(frozen=True)
class Column:
    """A field of a kind of rows."""

    name: str
    type: str
    unit: Optional[str]


@dataclass
class Table:
    """The rows of one kind, in their order. A vector is a tuple of 3 numbers (an orientation of 4:
    w, x, y, z), a message `bytes`."""

    columns: List[Column]
    rows: List[Tuple[Value, ...]] = field(default_factory=list)

    def __len__(self) -> int:
        return len(self.rows)

    def column(self, name: str) -> List[Value]:
        """All values of a field."""
        names = [column.name for column in self.columns]
        if name not in names:
            close = difflib.get_close_matches(name, names, 1)
            cure = f"did you mean '{close[0]}'?" if close else f"use one of {', '.join(names)}"
            raise ValueError(f"no column '{name}': {cure}")
        at = names.index(name)
        return [row[at] for row in self.rows]

    def dicts(self) -> List[Dict[str, Value]]:
        """Each row as a dictionary."""
        names = [column.name for column in self.columns]
        return [dict(zip(names, row)) for row in self.rows]

    def flat(self) -> List[Dict[str, Value]]:
        """Each row as a dictionary, with a key for each element of a vector, such as hip_x."""
        return [
            {name: value for key, one in row.items() for name, value in _elements(key, one)}
            for row in self.dicts()
        ]

    def to_numpy(self, name: str) -> Any:
        """All values of a field as a numpy.ndarray of shape (rows,), or of a vector (rows, 3).
        Needs numpy."""
        import numpy

        return numpy.array(self.column(name))

    def to_frame(self) -> Any:
        """All rows as a pandas.DataFrame with the columns of flat(). Needs pandas."""
        import pandas

        return pandas.DataFrame(self.flat())


@dataclass
class Record:
    """What a peer recorded. Times are nanoseconds of its CLOCK_BOOTTIME, all else SI units."""

    version: int
    config: Dict[str, Any]
    ticks: Table
    messages: Table
    sessions: Table
    bodies: Table
    cut_off: bool = False
    """The last row was not written to its end."""

    def time_s(self) -> List[float]:
        """The time of each tick, in seconds since the agreed start of the last session, as in the
        CSV of `hapnet-lab export`. Without a session it counts from the first tick."""
        due, late = self.ticks.column("due"), self.ticks.column("late")
        starts = self.sessions.column("start")
        woke = [a + b for a, b in zip(due, late)]
        zero = starts[-1] if starts else (woke[0] if woke else 0)
        return [(at - zero) * 1e-9 for at in woke]


def _elements(key: str, value: Value) -> Sequence[Tuple[str, Value]]:
    if not isinstance(value, tuple):
        return [(key, value)]
    axes = "xyz" if len(value) == 3 else "wxyz"
    return [(f"{key}_{axis}", one) for axis, one in zip(axes, value)]


class _Rows:
    """Reads the rows of one kind."""

    def __init__(self, schema: Dict[str, Any], row_bytes: int) -> None:
        self.row_bytes = row_bytes
        self.table = Table(
            [Column(one["name"], one["type"], one.get("unit")) for one in schema["fields"]]
        )
        self._readers = [(one["offset"], *self._layout(one["type"])) for one in schema["fields"]]

    @staticmethod
    def _layout(kind: str) -> Tuple[Optional[struct.Struct], bool]:
        if kind.startswith("u16 n"):
            return None, False
        name, _, count = kind.partition("[")
        number = count.rstrip("]")
        return struct.Struct(f"<{number}{_LETTERS[name]}"), bool(number)

    def add(self, row: bytes) -> None:
        values: List[Value] = []
        for offset, layout, is_vector in self._readers:
            if layout is None:
                (length,) = struct.unpack_from("<H", row, offset)
                if offset + 2 + length > len(row):
                    raise ValueError("a message is longer than its row")
                values.append(bytes(row[offset + 2 : offset + 2 + length]))
            else:
                read = layout.unpack_from(row, offset)
                values.append(read if is_vector else read[0])
        self.table.rows.append(tuple(values))


def read_record(path: str) -> Record:
    """Reads a record; one that was cut off up to its last whole row. Raises ValueError for a file
    that is no record, of a version not known here, or damaged."""
    with open(path, "rb") as file:
        line = file.readline(HEADER_BYTES_MAX)
        header = _header(line, path)
        rest = file.read()
    sizes = {
        "tick": header["row_bytes"],
        "session": header["row_bytes"],
        "message": header.get("message_row_bytes", header["row_bytes"]),
        "body": header.get("body_row_bytes", 0),
    }
    kinds: Dict[int, _Rows] = {}
    tables: Dict[str, Table] = {name: Table([]) for name in sizes}
    for name, schema in header["schema"].items():
        rows = _Rows(schema, sizes[name])
        kinds[schema["kind"]] = rows
        tables[name] = rows.table
    cut_off = _read_rows(rest, kinds, path)
    return Record(
        version=header["version"],
        config=header["config"],
        ticks=tables["tick"],
        messages=tables["message"],
        sessions=tables["session"],
        bodies=tables["body"],
        cut_off=cut_off,
    )


def _header(line: bytes, path: str) -> Dict[str, Any]:
    try:
        header = json.loads(line)
    except ValueError:
        header = None
    if not isinstance(header, dict) or header.get("format") != "hapnet-record":
        raise ValueError(f"{path} is not a record: its first line is not a header of one")
    if header.get("version") not in VERSIONS or header.get("byte_order") != "little":
        raise ValueError(f"{path} is a record of version {header.get('version')}, not of 2 to 5")
    return header


def _read_rows(rest: bytes, kinds: Dict[int, _Rows], path: str) -> bool:
    view, at, number = memoryview(rest), 0, 0
    while at < len(view):
        number += 1
        rows = kinds.get(view[at])
        if rows is None:
            raise ValueError(f"{path}: row {number} is damaged: there is no kind {view[at]}")
        if at + rows.row_bytes > len(view):
            return True
        try:
            rows.add(view[at : at + rows.row_bytes])
        except ValueError as wrong:
            raise ValueError(f"{path}: row {number} is damaged: {wrong}") from None
        at += rows.row_bytes
    return False
