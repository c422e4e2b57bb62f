# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""The command line of hapnet-study as a table. What parses it, its help, its manual page and its
completions all follow from here."""

from __future__ import annotations

import argparse
import difflib
import sys
from dataclasses import dataclass
from typing import NoReturn, Optional, Sequence

import hapnet

PROGRAM = "hapnet-study"
SUMMARY = ("Trials with people over an emulated network: plays the conditions of a design without "
           "showing them, asks, and finds the level that people notice.")
NOTES = """\
DESIGN is a file in TOML (docs/formats/study.md). Each trial is a session of two hapnet-peer through
hapnet-emulator on this machine. The programs are found in PATH, or in the folder HAPNET_BIN.

Answers are on the disk before the next question. After Ctrl-C or a crash the same command goes on
with the trial that has no answer yet. A participant is a number; no names are kept.

While a trial is played, Enter at the terminal ends the force at once."""
EXAMPLES = """\
  hapnet-study check delay.toml
  hapnet-study run delay.toml --participant 7
  hapnet-study run delay.toml --participant 7 --device falcon -- --force-limit 1N
  hapnet-study run delay.toml --participant 8 --observer simulated --dry
  hapnet-study analyse delay.toml
  hapnet-study analyse delay.toml --json"""
EXIT_CODES = """\
  0  done
  1  a session failed, or a trial was not valid again and again
  2  bad usage, or a design or answers with an error
  3  the system refused (no permission, disk full, no such program)
  130  interrupted; the same command goes on"""


@dataclass(frozen=True)
class Option:
    name: str
    value: str
    """What it takes; empty: nothing."""
    help: str
    commands: tuple[str, ...]
    choices: tuple[str, ...] = ()


COMMANDS = {
    "run": "Plays and asks the trials of one participant, from the first without an answer",
    "analyse": "Finds the thresholds of all participants, and writes tables and a figure",
    "check": "Checks a design, and prints what would be played and how long it takes",
}
OPTIONS = (
    Option("--participant", "N", "Number of the participant, 1 to 9999: the order of the trials "
           "follows from it. Of simulated ones also a range, as 1-10", ("run", "check")),
    Option("--out", "DIR", "Folder of the answers (default: results/ and the name of the design)",
           ("run", "analyse")),
    Option("--observer", "person|simulated", "Who answers: person (default), at the terminal; "
           "simulated, by the curve under observer of the design", ("run",),
           ("person", "simulated")),
    Option("--dry", "", "Play nothing, only ask; to try a design", ("run",)),
    Option("--device", "NAME", "The participant's device, A, as hapnet-peer takes it (default: "
           "sim). Words after -- are further options of that peer", ("run",)),
    Option("--partner", "NAME", "The device of the other side, B (default: sim)", ("run",)),
    Option("--keep-invalid", "", "Ask also after a trial in which the machine was too busy to keep "
           "its timing, and mark the answer. Without it such a trial is played again, "
           "at most twice", ("run",)),
    Option("--json", "", "Print one JSON object instead of text", ("analyse", "check")),
)
COMMON = (("-h", "--help", "", "Print help and exit"),
          ("-V", "--version", "", "Print the version and exit"),
          ("", "--generate", "man|bash|zsh|fish", "Print the manual page, for scdoc, or what "
           "completes the command line in a shell, and exit"))
GENERATE = ("man", "bash", "zsh", "fish")


class _Parser(argparse.ArgumentParser):
    """Refuses as the other programs do."""

    def error(self, message: str) -> NoReturn:
        words = message
        prefix = "unrecognized arguments: "
        if message.startswith(prefix):
            word = message[len(prefix):].split()[0]
            words = f"unknown {'option' if word.startswith('-') else 'argument'} {word}"
            near = difflib.get_close_matches(word, [one.name for one in OPTIONS], 1)
            words += f": did you mean {near[0]}?" if near else f": see {PROGRAM} --help"
        print(f"{PROGRAM}: {words}", file=sys.stderr)
        sys.exit(2)


def options_of(command: str) -> list[Option]:
    return [one for one in OPTIONS if command in one.commands]


def usage_of(command: str) -> str:
    """How a command is called."""
    words = [f"{PROGRAM} {command} DESIGN"]
    if command == "run":
        words.append("--participant N")
    words.append("[OPTIONS]")
    if command == "run":
        words.append("[-- PEER-OPTIONS]")
    return " ".join(words)


def parser() -> argparse.ArgumentParser:
    """What parses the command line, before the words after --."""
    commands = "".join(f"  {name:<12}{text}\n" for name, text in COMMANDS.items())
    top = _Parser(
        prog=PROGRAM, usage=f"{PROGRAM} COMMAND DESIGN [OPTIONS]", allow_abbrev=False,
        description=f"{SUMMARY}\n\nCommands ({PROGRAM} COMMAND --help says more):\n{commands}",
        epilog=f"{NOTES}\n\nExamples:\n{EXAMPLES}\n\nExit codes:\n{EXIT_CODES}",
        formatter_class=argparse.RawDescriptionHelpFormatter)
    top.add_argument("-V", "--version", action="version",
                     version=f"{PROGRAM} {hapnet.__version__}", help="Print the version and exit")
    top.add_argument("--generate", metavar="|".join(GENERATE), choices=GENERATE,
                     help=COMMON[2][3])
    kinds = top.add_subparsers(dest="command", metavar="COMMAND", parser_class=_Parser,
                               help=argparse.SUPPRESS)
    for name, text in COMMANDS.items():
        one = kinds.add_parser(name, usage=usage_of(name), description=f"{text}.",
                               allow_abbrev=False)
        one.add_argument("design", metavar="DESIGN", help="The design, a file in TOML")
        for option in options_of(name):
            if not option.value:
                one.add_argument(option.name, action="store_true", help=option.help)
                continue
            one.add_argument(option.name, metavar=option.value, help=option.help,
                             choices=option.choices or None)
    return top


def split(words: Sequence[str]) -> tuple[list[str], Optional[list[str]]]:
    """The words before and after --; None: there is no --."""
    words = list(words)
    if "--" not in words:
        return words, None
    at = words.index("--")
    return words[:at], words[at + 1:]
