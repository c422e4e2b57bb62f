# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""hapnet-lab: experiments in virtual time, and what becomes of records."""

from __future__ import annotations

import json
from typing import Any, Dict, List, Mapping, Optional

from hapnet.process import option_words, run
from hapnet.results import Row, read_csv, read_manifest


class Lab:
    """Runs of hapnet-lab. Everything raises ProgramFailed with the program's words."""

    def __init__(self, timeout: Optional[float] = None) -> None:
        """`timeout`: seconds that a run may take, None: without a limit."""
        self._timeout = timeout

    def run(
        self,
        experiment: str,
        out: str,
        settings: Optional[Mapping[str, str]] = None,
        **options: Any,
    ) -> "Experiment":
        """Plays an experiment, by its file or built-in name, into the folder `out`; what is there
        already is not played again. `settings` replace keys of its text: {"both.delay": "80ms"}.
        `options`: seeds=4, jobs=2, quick=True."""
        words = ["run", experiment, "--out", out, *option_words(options)]
        for key, value in (settings or {}).items():
            words += ["--set", f"{key}={value}"]
        run("hapnet-lab", words, self._timeout)
        return Experiment(out)

    def analyse(self, *records: str) -> Dict[str, Any]:
        """The analysis of a session by the records of its peers (docs/formats/statistics.md)."""
        text = run("hapnet-lab", ["analyse", *records, "--json"], self._timeout)
        result: Dict[str, Any] = json.loads(text)
        return result

    def replay(self, record: str, algorithm: Optional[str] = None) -> Dict[str, Any]:
        """Plays a record again: {"ticks": ..., ...}. Raises ProgramFailed when the forces of the
        recorded algorithm are not the recorded ones."""
        words = ["replay", record, "--json", *option_words({"algorithm": algorithm})]
        result: Dict[str, Any] = json.loads(run("hapnet-lab", words, self._timeout))
        return result

    def report(self, *what: str) -> str:
        """Writes the page for a folder of results or for records; returns its path."""
        return run("hapnet-lab", ["report", *what], self._timeout).strip().splitlines()[-1]


class Experiment:
    """The folder of an experiment that was run."""

    def __init__(self, folder: str) -> None:
        self.folder = folder

    @property
    def manifest(self) -> Dict[str, Any]:
        return read_manifest(self.folder)

    def rows(self, table: str) -> List[Row]:
        """The rows of a table such as "limits.csv": numbers as numbers, empty cells as None."""
        return read_csv(f"{self.folder}/{table}")
