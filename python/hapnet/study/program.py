# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""The program hapnet-study: what its commands do, and its exit codes."""

from __future__ import annotations

import argparse
import json
import os
import re
import shlex
import signal
import sys
import time
from typing import Any, Optional, Sequence

import hapnet
from hapnet.process import ProgramFailed
from hapnet.study import analyse, forecast
from hapnet.study.answers import Answers, AnswersError
from hapnet.study.design import Design, DesignError, read_design
from hapnet.study.observer import Left, Person, Simulated
from hapnet.study.options import PROGRAM, parser, split
from hapnet.study.pages import generated
from hapnet.study.run import NeverValid, Run, say, write_manifest
from hapnet.study.stage import Stage, verify

DONE, FAILED, BAD_USAGE, SYSTEM, INTERRUPTED = 0, 1, 2, 3, 130


class BadUsage(Exception):
    """A command line that means nothing."""


def main(words: Optional[Sequence[str]] = None) -> int:
    """Runs the program; returns its exit code."""
    own, beyond = split(sys.argv[1:] if words is None else words)
    given = parser().parse_args(own)
    try:
        if given.generate:
            print(generated(given.generate), end="")
            return DONE
        if given.command is None:
            raise BadUsage(f"which command? See {PROGRAM} --help")
        if beyond is not None and given.command != "run":
            raise BadUsage("words after -- are options of a peer: they go with run")
        design = read_design(given.design)
        code = {"run": _run, "analyse": _analyse, "check": _check}[given.command](
            design, given, beyond or [])
        sys.stdout.flush()  # here, where a refusal is told
        return code
    except (BadUsage, DesignError, AnswersError) as wrong:
        return _refuse(str(wrong), BAD_USAGE)
    except (NeverValid, Left) as failed:
        return _refuse(str(failed), FAILED)
    except ProgramFailed as failed:
        return _refuse(str(failed), FAILED if failed.code is not None else SYSTEM)
    except OSError as refused:
        return _refused_by_system(refused, given)
    except KeyboardInterrupt:
        return _refuse("interrupted; the same command goes on with the trial that has no answer",
                       INTERRUPTED)


def _refused_by_system(refused: OSError, given: argparse.Namespace) -> int:
    if isinstance(refused, BrokenPipeError):  # as by head: what is left is for no one
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        words = "the output is closed; the same command goes on"
        return _refuse(words, SYSTEM) if given.command == "run" else SYSTEM
    words = refused.strerror or str(refused)
    if isinstance(refused, FileNotFoundError) and refused.filename == given.design:
        return _refuse(f"{given.design}: there is no such file", BAD_USAGE)
    if refused.filename == given.design:
        return _refuse(f"{given.design}: {words}: name a design, a file in TOML", BAD_USAGE)
    if refused.filename is None:
        return _refuse(words, SYSTEM)
    return _refuse(f"{refused.filename}: {words}: see to it, or name another --out", SYSTEM)


def _refuse(words: str, code: int) -> int:
    print(f"{PROGRAM}: {words}", file=sys.stderr)
    return code


def _run(design: Design, given: argparse.Namespace, beyond: list[str]) -> int:
    for one in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(one, signal.default_int_handler)
    if given.participant is None:
        raise BadUsage("--participant: which number?")
    participants = _numbers(given.participant)
    is_simulated = given.observer == "simulated"
    if len(participants) > 1 and not is_simulated:
        raise BadUsage(f"--participant {given.participant}: a range is for --observer simulated")
    if is_simulated and design.observer is None:
        raise BadUsage(f"{design.file}: there is no observer: write observer = {{ threshold = …, "
                       "slope = 4 }")
    if given.dry and (given.device or given.partner or beyond):
        raise BadUsage("--dry plays nothing: leave out --device, --partner and what follows --")
    if not given.dry:
        verify(design)
    for participant in participants:
        _ask(design, participant, given, beyond)
    return DONE


def _ask(design: Design, participant: int, given: argparse.Namespace, beyond: list[str]) -> None:
    """All trials of one participant that have no answer yet."""
    is_simulated = given.observer == "simulated"
    stage = None
    if not given.dry:
        stage = Stage(design, participant, given.device, given.partner, beyond)
    out = _out(design, given)
    head = {"observer": "simulated" if is_simulated else "person", "dry": given.dry,
            "version": hapnet.__version__}
    started = time.time()
    with Answers(design, participant, out, head) as answers:
        who: Any = Simulated(design, participant) if is_simulated else Person(design)
        try:
            count = Run(design, answers, who, stage, given.keep_invalid).to_the_end()
        except Left:
            raise Left("the input ended before the last trial; the same command goes on") from None
        finally:
            command = shlex.join([PROGRAM, *sys.argv[1:]])
            write_manifest(answers.folder, design, command, started, answers, given.dry)
        say(f"All {count} trials of participant {participant} are answered: {answers.path}")


def _analyse(design: Design, given: argparse.Namespace, _: list[str]) -> int:
    out = _out(design, given)
    if not os.path.isdir(out):
        raise AnswersError(f"{out}: there is no such folder: start {PROGRAM} run first, or name "
                           "another --out")
    result = analyse.analysed(design, out)
    files = analyse.write(design, out, result)
    if given.json:
        print(json.dumps(result, indent=2))
    else:
        print("\n".join([*analyse.told(design, result), f"written: {', '.join(files)}"]))
    return DONE


def _check(design: Design, given: argparse.Namespace, _: list[str]) -> int:
    result = forecast.of(design, _numbers(given.participant or "1")[0])
    try:
        verify(design)
    except ProgramFailed as missing:
        print(f"{PROGRAM}: conditions, algorithm and scene were not checked: {missing}",
              file=sys.stderr)
    print(json.dumps(result, indent=2) if given.json else "\n".join(forecast.told(design, result)))
    return DONE


def _numbers(text: str) -> list[int]:
    """Participants: "7", "07" or "1-10"."""
    found = re.fullmatch(r"(\d{1,9})(?:-(\d{1,9}))?", text)
    first, last = (int(found[1]), int(found[2] or found[1])) if found else (0, 0)
    if not 1 <= first <= last <= 9999:
        raise BadUsage(f"--participant {text}: write a number from 1 to 9999; no names are kept")
    return list(range(first, last + 1))


def _out(design: Design, given: argparse.Namespace) -> str:
    stem = os.path.splitext(os.path.basename(design.file))[0]
    return given.out or os.path.join("results", stem)
