# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Judges the sessions of an experiment by a metric of one's own: a function of their records.

docs/use/python.md has an example; `python3 -m hapnet.judge --help` is the command line."""

from __future__ import annotations

import argparse
import importlib.util
import os
import shutil
import sys
from typing import List, Mapping, Optional, Sequence

from hapnet.measure import Measured, Metric, digest_of, measure, play, write_csv
from hapnet.process import ProgramFailed
from hapnet.threshold import Threshold
from hapnet.verdict import (
    GOOD, CannotJudge, Group, Limits, Verdict, judged, thresholds, unit_of,
)

__all__ = ["CannotJudge", "Group", "Limits", "Threshold", "Verdict", "run", "thresholds"]

COLUMNS = (*Group._fields, "seeds", "mean", "ci_low", "ci_high", "unit", "limit", "verdict",
           "usable_seeds", "usable_ci_low", "usable_ci_high")
P50_COLUMNS = ("parameter", "algorithm", "task", "seeds", *Threshold._fields, "unit")
DONE, NOT_ALL_GOOD, BAD_INPUT, SYSTEM, INTERRUPTED = 0, 1, 2, 3, 130


class _Line:
    """Progress on stderr: one line at a terminal. `asked`: None, only there."""

    def __init__(self, asked: Optional[bool]) -> None:
        self._at_terminal = sys.stderr.isatty()
        self._wanted = self._at_terminal if asked is None else asked
        self._end = ""

    def show(self, words: str) -> None:
        if self._wanted and self._at_terminal:
            print(f"\r{words}\x1b[K", end="", file=sys.stderr, flush=True)
            self._end = "\n"
        elif self._wanted:
            print(words, file=sys.stderr, flush=True)

    def finish(self) -> None:
        print(end=self._end, file=sys.stderr, flush=True)


def run(experiment: str, metric: Metric, *, out: str, at_most: Optional[float] = None,
        at_least: Optional[float] = None, unit: str = "", seeds: int = 10,
        settings: Optional[Mapping[str, str]] = None, jobs: Optional[int] = None,
        name: Optional[str] = None, progress: Optional[bool] = None) -> List[Verdict]:
    """Plays an experiment of kind table1 or trajectories once per seed, and calls `metric` with the
    records of each session in the order of the players: metric(a, b). It returns a finite number.
    Of recorded hands only the first trial has records.

    `seeds`: how many, 1 to 1000, from first_seed of the experiment on. `at_most`, `at_least`: the
    limits, finite, in `unit`; a session is usable if they allow its value. `settings`: as for
    Lab.run. `jobs`: threads of hapnet-lab, None: all. `name`: instead of the function's own.
    `progress`: on stderr; None: if that is a terminal.

    Writes OUT/NAME.csv, a row per group; after each seed OUT/NAME-sessions.csv, a row per session;
    and OUT/NAME-p50.csv, where thresholds() of the result has rows. A seed whose rows stand there
    is not played again while the experiment, the files that it names, the programs and the text of
    the function are the same; else its rows are replaced. Records are removed once they are
    measured. After Ctrl-C, the next call goes on with the sessions of the seed that was played.
    Raises CannotJudge, which names session and reason, ProgramFailed or OSError."""
    name = name or str(getattr(metric, "__name__", ""))
    if not name.isidentifier():
        raise CannotJudge(f"the metric's name '{name}' cannot name files: give one such as "
                          "name='drift'")
    if not 1 <= seeds <= 1000:
        raise CannotJudge(f"seeds {seeds}: give a number from 1 to 1000")
    limits = Limits(at_most, at_least)
    os.makedirs(out, exist_ok=True)
    work = os.path.join(out, f"{name}-playing")
    line = _Line(progress)
    given = {**(settings or {}), "record": "true"}
    try:
        digest = digest_of(experiment, given, metric, work)
        table = Measured(os.path.join(out, f"{name}-sessions.csv"), digest, name)
        first = min(table.by_seed, default=None)
        left = [i for i in range(seeds) if first is None or first + i not in table.by_seed]
        for played, i in enumerate(left):
            at = None if first is None else first + i
            seed, sessions = play(experiment, given, at, work, jobs)
            first = seed if first is None else first
            values = {}
            for group, records in sessions.items():
                number = played * len(sessions) + len(values) + 1
                line.show(f"session {number} of {len(left) * len(sessions)}")
                values[group] = measure(metric, f"{name} of {group}, seed {seed}", records)
            table.add(seed, values)
        line.show("tables")  # the fits of many thresholds take a while
        verdicts = [judged(group, of, limits) for group, of in table.of_first(seeds).items()]
        _write(os.path.join(out, name), verdicts, unit, limits)
    except BaseException as ended:
        if not isinstance(ended, KeyboardInterrupt):  # after which a later run needs its sessions
            shutil.rmtree(work, ignore_errors=True)
        raise
    finally:
        line.finish()
    shutil.rmtree(work, ignore_errors=True)
    return verdicts


def _write(path: str, verdicts: Sequence[Verdict], unit: str, limits: Limits) -> None:
    """Writes the tables of the groups and, where there are any, of their thresholds."""
    write_csv(f"{path}.csv", COLUMNS, [
        (*one.group, len(one.values), one.mean, one.ci_low, one.ci_high, unit, limits, one.verdict,
         one.usable_seeds, *one.usable_interval) for one in verdicts])
    found = thresholds(verdicts)
    if found:
        seeds = len(verdicts[0].values)
        write_csv(f"{path}-p50.csv", P50_COLUMNS, [
            (group.parameter, group.algorithm, group.task, seeds, *one, unit_of(group.parameter))
            for group, one in found.items()])
    elif os.path.exists(f"{path}-p50.csv"):
        os.remove(f"{path}-p50.csv")  # of other limits


def _loaded(text: str) -> Metric:
    """The function that FILE:FUNCTION names. Running the file is what Python does with it."""
    path, _, name = text.rpartition(":")
    if not os.path.isfile(path):
        raise CannotJudge(f"--metric {text}: there is no file '{path}': write FILE.py:FUNCTION")
    spec = importlib.util.spec_from_file_location("metric_of_ones_own", path)
    if spec is None or spec.loader is None:
        raise CannotJudge(f"--metric {text}: {path} is no Python: name a file that ends in .py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    try:
        spec.loader.exec_module(module)
    except Exception as wrong:
        raise CannotJudge(f"--metric {text}: {path} raised {type(wrong).__name__}: {wrong}: "
                          "correct the file") from wrong
    found = getattr(module, name, None)
    if not callable(found):
        raise CannotJudge(f"--metric {text}: {path} has no function '{name}': name one "
                          "that it has")
    metric: Metric = found
    return metric


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python3 -m hapnet.judge", allow_abbrev=False,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        description="Plays an experiment once per seed, and judges its sessions by a function of\n"
        "their records. Run again, it plays only the missing seeds.",
        epilog="Writes DIR/FUNCTION.csv, DIR/FUNCTION-sessions.csv and, with an axis over a\n"
        "delay, a jitter or a loss, DIR/FUNCTION-p50.csv: the level at which half of the\n"
        "sessions fail. The programs are found in PATH, or in the folder HAPNET_BIN.\n\n"
        "Example:\n  python3 -m hapnet.judge my.toml "
        "--metric mine.py:drift --at-most 2.0 \\\n    --unit mm --seeds 10 --out results/mine\n\n"
        "Exit codes:\n  0  every verdict is good, or there is no limit\n"
        "  1  a verdict is not good or undecided, or hapnet-lab failed\n  2  bad usage or input\n"
        "  3  the system refused (no permission, disk full, no such program)\n"
        "  130  interrupted; the same command goes on")
    parser.add_argument("experiment", metavar="EXPERIMENT", help="A file, or a built-in name, of "
                        "kind table1 or trajectories (docs/formats/experiment.md)")
    parser.add_argument("--metric", metavar="FILE.py:FUNCTION", required=True, help="A function "
                        "that takes the records of a session and returns a number")
    parser.add_argument("--out", metavar="DIR", required=True, help="The folder for the tables")
    for option, sense in (("--at-most", "highest"), ("--at-least", "lowest")):
        parser.add_argument(option, metavar="LIMIT", type=float,
                            help=f"The {sense} mean that is good (default: none)")
    parser.add_argument("--unit", metavar="UNIT", default="", help="Of the metric and its limits")
    parser.add_argument("--seeds", metavar="N", type=int, default=10,
                        help="Number of seeds, 1 to 1000 (default: 10)")
    parser.add_argument("--set", metavar="KEY=VALUE", action="append", default=[],
                        help="Another value for a key of the experiment; may be given "
                        "several times")
    parser.add_argument("--jobs", metavar="N", type=int, help="Threads (default: all processors)")
    parser.add_argument("--progress", action="store_true", default=None,
                        help="Tell each session on stderr, also where that is no terminal")
    return parser


def main(words: Optional[Sequence[str]] = None) -> int:
    """The command line; returns the exit code."""
    given = _parser().parse_args(words)
    try:
        if not all("=" in one for one in given.set):
            raise CannotJudge("--set: write KEY=VALUE")
        settings = dict(one.split("=", 1) for one in given.set)
        verdicts = run(given.experiment, _loaded(given.metric), out=given.out, unit=given.unit,
                       at_most=given.at_most, at_least=given.at_least, seeds=given.seeds,
                       settings=settings, jobs=given.jobs, progress=given.progress)
    except CannotJudge as wrong:
        return _refuse(str(wrong), BAD_INPUT)
    except ProgramFailed as failed:
        return _refuse(str(failed), SYSTEM if failed.code is None else failed.code)
    except OSError as refused:
        return _refuse(f"{refused}: see to it, or name another --out", SYSTEM)
    except KeyboardInterrupt:
        return _refuse("interrupted; the same command goes on", INTERRUPTED)
    _tell(verdicts, given.unit)
    return DONE if all(one.verdict in (GOOD, None) for one in verdicts) else NOT_ALL_GOOD


def _tell(verdicts: Sequence[Verdict], unit: str) -> None:
    """Prints a line for each group and for each threshold."""
    for one in verdicts:
        ends = "" if one.ci_low is None else f" ({one.ci_low:.4g} to {one.ci_high:.4g})"
        told = "" if one.verdict is None else (
            f" {one.verdict}; usable {one.usable_seeds} of {len(one.usable)}")
        print(f"{one.group}: {one.mean:.4g}{ends} {unit}".rstrip() + told)
    for group, found in thresholds(verdicts).items():
        sign = "" if found.bound == "=" else "> "
        high = "?" if found.ci_high is None else f"{found.ci_high:.4g}"
        print(f"{group.algorithm}-{group.task}: half fail at {group.parameter} {sign}"
              f"{found.p50:.4g} ({found.ci_low:.4g} to {high}) {unit_of(group.parameter)}")


def _refuse(words: str, code: int) -> int:
    print(f"hapnet.judge: {words}", file=sys.stderr)
    return code


if __name__ == "__main__":
    sys.exit(main())
