# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Tables and manifests of results."""

from __future__ import annotations

import csv
import json
import math
import os
from typing import Any, Dict, List, Optional, Union

Cell = Union[str, int, float, None]
Row = Dict[str, Cell]


def _cell(text: Optional[str]) -> Cell:
    if text is None or text == "":
        return None
    for kind in (int, float):
        try:
            value = kind(text)
        except ValueError:
            continue
        return value if math.isfinite(value) else text
    return text


def read_csv(path: str) -> List[Row]:
    """The rows of a CSV file of Hapnet, as dictionaries by the names of its header, which have the
    units. Numbers are int or float, empty cells None."""
    with open(path, encoding="utf-8", newline="") as file:
        return [{key: _cell(value) for key, value in row.items()} for row in csv.DictReader(file)]


def to_frame(rows: List[Row]) -> Any:
    """The rows as a pandas.DataFrame. Needs pandas."""
    import pandas

    return pandas.DataFrame(rows)


def read_manifest(folder: str) -> Dict[str, Any]:
    """The manifest of a folder of results: its experiment, version, machine, and whether it is
    valid."""
    with open(os.path.join(folder, "manifest.json"), encoding="utf-8") as file:
        manifest: Dict[str, Any] = json.load(file)
    return manifest


def write_whole(path: str, text: str) -> None:
    """Replaces a file by one with this text. A reader finds either the old file or the new one."""
    beside = f"{path}.new"
    with open(beside, "w", encoding="utf-8") as file:
        file.write(text)
        file.flush()
        os.fsync(file.fileno())
    os.replace(beside, path)
