# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Runs the programs in a folder, and collects what they print and write."""

import json
import os
import shlex
import socket
import subprocess
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, List, Optional

PARTS = {".json": "json", ".jsonl": "jsonl", ".html": "page"}
LEFT_OUT = {".rec", ".svg", ".sock"}


@dataclass
class Output:
    """One thing that a program has printed or written."""

    label: str
    text: str
    form: str = "text"
    schema: Optional[str] = None
    whole: Optional[str] = None  # where the text is a shape: what was printed


@dataclass
class Step:
    """A command, or a function of the programs that returns outputs of its own. files: what it
    writes and is looked at, with all of a folder. schema: that of what it prints."""

    run: Any
    files: List[str] = field(default_factory=list)
    exit: int = 0
    schema: Optional[str] = None


class Client:
    """A client of a control socket."""

    def __init__(self, path):
        self.socket = socket.socket(socket.AF_UNIX)
        self.socket.settimeout(20)
        self.socket.connect(str(path))
        self.file = self.socket.makefile("rw")

    def send(self, request):
        self.file.write(json.dumps(request) + "\n")
        self.file.flush()

    def ask(self, request):
        self.send(request)
        return self.read()

    def read(self):
        return self.file.readline()


class Programs:
    """The programs of a folder, run in another one."""

    def __init__(self, folder, place):
        self.folder, self.place = Path(folder).resolve(), Path(place)
        self.environment = {**os.environ, "XDG_STATE_HOME": str(self.place / "state"),
                            "PATH": f"{self.folder}:{os.environ['PATH']}"}
        self.started = []

    def run(self, words, exit=0):
        """The finished process. exit: the code that it must end with; None: any."""
        done = subprocess.run(shlex.split(words), cwd=self.place, env=self.environment, text=True,
                              capture_output=True, stdin=subprocess.DEVNULL, timeout=100)
        if exit is not None and done.returncode != exit:
            raise AssertionError(
                f"{words}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
        return done

    def start(self, words, *more):
        process = subprocess.Popen([*shlex.split(words), *more], cwd=self.place, text=True,
                                   env=self.environment, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.started.append(process)
        return process

    def stop_all(self):
        """Ends what still runs, after a failure."""
        for process in self.started:
            if process.poll() is None:
                process.kill()
                process.communicate()

    def connect(self, name):
        return Client(self.place / name)

    def follow(self, step):
        """The outputs of a step."""
        if callable(step.run):
            yield from step.run(self)
        else:
            done = self.run(step.run, step.exit)
            form = "json" if "--json" in step.run else "text"
            yield Output(f"$ {step.run}", done.stdout, form, step.schema)
            if done.stderr:
                yield Output("stderr", done.stderr)
        for name in step.files:
            yield from self.files(name)

    def files(self, name):
        """The texts of a file, or of all files of a folder."""
        path = self.place / name
        for file in sorted(path.rglob("*")) if path.is_dir() else [path]:
            if file.is_file() and file.suffix not in LEFT_OUT:
                yield Output(str(file.relative_to(self.place)), file.read_text(),
                             PARTS.get(file.suffix, "text"))
