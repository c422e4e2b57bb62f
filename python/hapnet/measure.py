# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Sessions that are played for their records, and what a metric said of each."""

from __future__ import annotations

import contextlib
import csv
import glob
import hashlib
import inspect
import io
import math
import numbers
import os
import shutil
from typing import Any, Callable, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple

from hapnet.lab import Lab
from hapnet.process import ProgramFailed
from hapnet.process import run as run_program
from hapnet.record import read_record
from hapnet.results import write_whole
from hapnet.verdict import CannotJudge, Group

Metric = Callable[..., float]
COLUMNS = ("digest", "metric", *Group._fields, "seed", "measured")


def write_csv(path: str, header: Sequence[str], rows: Iterable[Sequence[Any]]) -> None:
    """Replaces a table. None is an empty cell; numbers have all their digits."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(header)
    writer.writerows(rows)
    write_whole(path, text.getvalue())


def digest_of(experiment: str, settings: Mapping[str, str], metric: Metric, work: str) -> str:
    """BLAKE2b of all that decides the values of a seed: of the plan, which holds the experiment,
    its files and the build, and of the function's text. `work`: a folder for the plan. Its
    sessions are removed if they are of another plan."""
    kept, before = os.path.join(work, "plan.json"), b""
    if os.path.exists(kept):
        with open(kept, "rb") as file:
            before = file.read()
    words = [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]
    try:
        run_program("hapnet-lab", ["plan", experiment, "--out", work, *words])
    except ProgramFailed as failed:
        if "records are kept by" not in str(failed):
            raise
        raise CannotJudge(f"{experiment}: an experiment of its kind keeps no records: write kind = "
                          f"\"table1\" or \"trajectories\" ({failed})") from failed
    with open(kept, "rb") as file:
        plan = file.read()
    if plan != before:
        _clear(work, but=("plan.json",))
    try:
        text = inspect.getsource(metric).encode()
    except (OSError, TypeError):  # typed at a prompt: no run knows it again
        text = os.urandom(16)
    return hashlib.blake2b(plan + text, digest_size=16).hexdigest()


class Measured:
    """The table of sessions: a row each, with all that a later run needs to leave it out."""

    def __init__(self, path: str, digest: str, metric: str) -> None:
        """Reads the rows of this digest and metric; others are replaced at the next add()."""
        self._path, self._of = path, (digest, metric)
        self.by_seed: Dict[int, Dict[Group, float]] = {}
        if not os.path.exists(path):
            return
        with open(path, encoding="utf-8", newline="") as file:
            for number, row in enumerate(csv.DictReader(file), 2):
                try:
                    if (row["digest"], row["metric"]) == self._of:
                        group = Group(*(row[key] for key in Group._fields))
                        values = self.by_seed.setdefault(int(row["seed"]), {})
                        values[group] = float(row["measured"])
                except (KeyError, TypeError, ValueError):
                    raise CannotJudge(f"{path}:{number}: it is no row of a metric: remove the file "
                                      "or name another folder") from None

    def of_first(self, seeds: int) -> Dict[Group, Dict[int, float]]:
        """The values by seed of each group, of this number of the lowest seeds."""
        chosen = sorted(self.by_seed)[:seeds]
        return {group: {seed: self.by_seed[seed][group] for seed in chosen}
                for group in self.by_seed[chosen[0]]}

    def add(self, seed: int, values: Dict[Group, float]) -> None:
        """Notes all sessions of a seed on the disk."""
        self.by_seed[seed] = values
        write_csv(self._path, COLUMNS, [
            (*self._of, *group, one, repr(value)) for one in sorted(self.by_seed)
            for group, value in self.by_seed[one].items()])


def play(experiment: str, settings: Mapping[str, str], seed: Optional[int], work: str,
         jobs: Optional[int]) -> Tuple[int, Dict[Group, List[str]]]:
    """Plays one seed into the folder `work`; None: the first of the experiment. Sessions that an
    interrupted call has left there are not played again. Returns the seed, and by group the
    records in the order of the players. Raises ProgramFailed and CannotJudge."""
    _clear(work, but=("plan.json", "sessions.jsonl"))
    first = {} if seed is None else {"first_seed": str(seed)}
    done = Lab().run(experiment, work, {**settings, **first}, seeds=1, jobs=jobs)
    sessions: Dict[Group, List[str]] = {}
    values: List[str] = []
    for table in glob.glob(os.path.join(glob.escape(work), "sessions*.csv")):
        with open(table, encoding="utf-8", newline="") as file:
            for row in csv.DictReader(file):
                folder, group = _group_of(row, values)
                name = f"{group.algorithm}-{group.task}"
                kept = os.path.join(work, "records", folder, name)
                sessions[group] = sorted(glob.glob(os.path.join(glob.escape(kept), "peer-*.rec")))
    silent = [group for group, records in sessions.items() if not records]
    if silent or not sessions:
        which = silent[0] if silent else "the experiment"
        raise CannotJudge(f"{experiment}: {which} left no records: play an experiment of kind "
                          "table1 or trajectories, by the hapnet-lab of this version")
    return int(done.manifest["seeds"][0]), sessions


def _clear(folder: str, but: Sequence[str]) -> None:
    """Removes all of a folder, which need not be there, but the files of these names."""
    with contextlib.suppress(FileNotFoundError):
        for one in os.scandir(folder):
            if one.is_dir(follow_symlinks=False):
                shutil.rmtree(one.path)
            elif one.name not in but:
                os.remove(one.path)


def _group_of(row: Mapping[str, str], values: List[str]) -> Tuple[str, Group]:
    """The folder of a session's point, and its group. `values`: those of the axis so far."""
    keys = list(row)[: list(row).index("algorithm")]
    cells = [row[key] for key in keys]
    ends = (row["algorithm"], row["task"])
    if not keys:
        return "", Group("", "", *ends)
    if keys[0] == "point":  # several axes
        return f"point-{cells[0]}", Group("; ".join(keys[1:]), "; ".join(cells[1:]), *ends)
    parameter, value = cells
    if value not in values:
        values.append(value)
    folder = f"point-{values.index(value) + 1}" if "/" in value else value
    return folder, Group(parameter, value, *ends)


def measure(metric: Metric, where: str, paths: Sequence[str]) -> float:
    """Calls the metric with the records. Raises CannotJudge, which names `where`."""
    records = [read_record(path) for path in paths]
    try:
        value = metric(*records)
    except Exception as wrong:
        raise CannotJudge(f"{where}: it raised {type(wrong).__name__}: {wrong}: correct the "
                          "function; seeds before this one are kept") from wrong
    if not isinstance(value, numbers.Real) or not math.isfinite(value):
        raise CannotJudge(f"{where}: it returned {value!r}: return a finite number")
    return float(value)
