# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Programs as child processes: found, started, waited for, and ended."""

from __future__ import annotations

import os
import queue
import shutil
import signal
import subprocess
import tempfile
import threading
import time
from typing import Any, Dict, IO, List, Optional, Sequence, Type, TypeVar

from hapnet.control import ControlSocket, Reply

LINES_KEPT = 10_000
Self = TypeVar("Self", bound="Daemon")


class ProgramFailed(Exception):
    """A program ended with another code than 0, or not at all. The text has its last words.

    `code`: 1 the run failed, 2 wrong usage or input, 3 the system refused; None: it is still
    running, or could not be started."""

    def __init__(self, message: str, code: Optional[int] = None) -> None:
        super().__init__(message)
        self.code = code


def find_program(name: str) -> str:
    """The path of a program: in the folder HAPNET_BIN, or else in PATH."""
    folder = os.environ.get("HAPNET_BIN")
    path = shutil.which(name, path=folder) if folder else shutil.which(name)
    if path is None:
        where = f"the folder HAPNET_BIN={folder}" if folder else "PATH"
        cure = "name its folder" if folder else "add its folder, or set HAPNET_BIN to it"
        raise ProgramFailed(f"{name} is not in {where}: {cure}")
    return path


def option_words(options: Dict[str, Any]) -> List[str]:
    """Keyword arguments as options of a command line: `up_delay="5ms"` is --up.delay 5ms, `True`
    an option alone, None and False no option, and a list the same option several times."""
    words: List[str] = []
    for key, value in options.items():
        name = key.rstrip("_").replace("_", "-")
        for way in ("up", "down", "both"):
            if name.startswith(way + "-"):
                name = way + "." + name[len(way) + 1 :]
        for one in value if isinstance(value, (list, tuple)) else [value]:
            if one is None or one is False:
                continue
            words.append("--" + name)
            if one is not True:
                words.append(str(one))
    return words


class Lifeline:
    """A pipe whose one end only this process has. The programs of this project that hold the other
    end stop when it hangs up: when this process has ended, whatever ended it, or at close()."""

    def __init__(self) -> None:
        self._reading, self._writing = os.pipe()

    def given(self, folder: str = "") -> Dict[str, Any]:
        """Keyword arguments that hand the other end to subprocess.Popen. `folder`: the folder
        that the program removes at its end if this process has ended before."""
        variables = dict(os.environ, HAPNET_LIFELINE=str(self._reading))
        if folder:
            variables["HAPNET_LIFELINE_FOLDER"] = folder
        return {"pass_fds": (self._reading,), "env": variables}

    def close(self) -> None:
        """Closes the pipe: programs that still hold its other end stop."""
        os.close(self._reading)
        os.close(self._writing)


def run(name: str, words: Sequence[str], timeout: Optional[float] = None) -> str:
    """Runs a program to its end and returns what it printed. Raises ProgramFailed when its exit
    code is not 0, or after `timeout` seconds."""
    lifeline = Lifeline()
    try:
        done = subprocess.run(
            [find_program(name), *words],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            timeout=timeout,
            check=False,
            **lifeline.given(),
        )
    except subprocess.TimeoutExpired as late:
        raise ProgramFailed(f"{name} was not done after {timeout} s") from late
    finally:
        lifeline.close()
    if done.returncode != 0:
        said = done.stderr.decode(errors="replace").strip()
        raise ProgramFailed(f"{name} ended with {done.returncode}: {said}", done.returncode)
    return done.stdout.decode()


class Daemon:
    """A program that runs until it is told to stop, with a control socket. A context manager:
    started on entering, stopped on leaving. It stops, too, when this process is killed."""

    program = ""

    def __init__(self, words: Sequence[str], start_within: float = 10.0) -> None:
        self._words = list(words)
        self._start_within = start_within
        self._process: Optional[subprocess.Popen[bytes]] = None
        self._control: Optional[ControlSocket] = None
        self._folder: Optional[tempfile.TemporaryDirectory[str]] = None
        self._lifeline: Optional[Lifeline] = None
        self._out: "queue.Queue[Optional[str]]" = queue.Queue(LINES_KEPT)
        self._err: List[str] = []
        self._threads: List[threading.Thread] = []
        self.ready: Dict[str, str] = {}
        """The keys and values of its line "ready"."""
        self.control_path = ""
        """Where its control socket is while it runs, for other clients."""

    # Life

    def start(self: Self) -> Self:
        """Starts it and waits until it is ready."""
        program = find_program(self.program)
        self._folder = tempfile.TemporaryDirectory(prefix="hapnet-")
        self.control_path = os.path.join(self._folder.name, "control.sock")
        self._lifeline = Lifeline()
        self._process = subprocess.Popen(
            [program, *self._words, "--control", self.control_path],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            **self._lifeline.given(self._folder.name),
        )
        self._read(self._process.stdout, self._keep_out)
        self._read(self._process.stderr, self._keep_err)
        try:
            self._await_ready()
            self._control = ControlSocket(self.control_path)
        except BaseException:
            self.kill()
            raise
        return self

    def stop(self, within: float = 15.0) -> None:
        """Ends the program by SIGTERM: it writes its files and sets motors to zero force. Raises
        ProgramFailed if it ends with another code than 0, or not `within` these seconds: then it
        is killed."""
        if self._process is None:
            return
        if self._process.poll() is None:
            self._process.send_signal(signal.SIGTERM)
        self.join(within)

    def join(self, within: Optional[float] = None) -> None:
        """Waits for its own end, as after --duration; otherwise like stop()."""
        if self._process is None:
            return
        try:
            code = self._process.wait(within)
        except subprocess.TimeoutExpired:
            self.kill()
            raise ProgramFailed(f"{self.program} did not end within {within} s") from None
        self._clear()
        if code != 0:
            raise ProgramFailed(f"{self.program} ended with {code}: {self.said()}", code)

    def kill(self) -> None:
        """Kills the program at once. Use it with simulated devices only: a real one may keep its
        last force."""
        if self._process is not None:
            self._process.kill()
            self._process.wait()
        self._clear()

    def __enter__(self: Self) -> Self:
        return self.start()

    def __exit__(self, kind: Optional[Type[BaseException]], *_: object) -> None:
        try:
            self.stop()
        except ProgramFailed:
            if kind is None:
                raise  # otherwise the user needs the first error

    # What it says

    @property
    def control(self) -> ControlSocket:
        """The connection to its control socket."""
        if self._control is None:
            raise ProgramFailed(f"{self.program} is not running")
        return self._control

    def said(self) -> str:
        """Its lines on stderr so far."""
        return "\n".join(self._err)

    def is_running(self) -> bool:
        return self._process is not None and self._process.poll() is None

    def stats(self) -> Reply:
        """The statistics of this moment (docs/formats/statistics.md)."""
        return self.control.request("stats")

    def show(self) -> Reply:
        return self.control.request("show")

    def wait(self, until: str, timeout: float = 10.0) -> bool:
        """Waits until a condition such as "up.received>1000" holds; False: it did not in time."""
        return self.control.wait(until, timeout)

    # Inside

    def _await_ready(self) -> None:
        end = time.monotonic() + self._start_within
        while True:
            try:
                line = self._out.get(timeout=max(0.0, end - time.monotonic()))
            except queue.Empty:
                raise ProgramFailed(
                    f"{self.program} was not ready after {self._start_within} s: {self.said()}"
                ) from None
            if line is None:  # it closed its stdout, so it has ended or is about to
                process = self._process
                code = process.wait(self._start_within) if process else None
                for thread in self._threads:
                    thread.join(1.0)
                raise ProgramFailed(f"{self.program} ended with {code}: {self.said()}", code)
            if line.startswith("ready "):
                self.ready = dict(
                    word.split("=", 1) for word in line.split()[1:] if "=" in word
                )
                return

    def _read(self, stream: Optional[IO[bytes]], keep: Any) -> None:
        def pump() -> None:
            assert stream is not None
            for line in stream:
                keep(line.decode(errors="replace").rstrip("\n"))
            keep(None)

        thread = threading.Thread(target=pump, daemon=True)
        thread.start()
        self._threads.append(thread)

    def _keep_out(self, line: Optional[str]) -> None:
        try:
            self._out.put_nowait(line)
        except queue.Full:
            pass

    def _keep_err(self, line: Optional[str]) -> None:
        if line is not None and len(self._err) < LINES_KEPT:
            self._err.append(line)

    def _clear(self) -> None:
        for thread in self._threads:
            thread.join(5.0)
        self._threads = []
        if self._process is not None:
            for stream in (self._process.stdout, self._process.stderr):
                if stream is not None:
                    stream.close()
        if self._control is not None:
            self._control.close()
            self._control = None
        if self._lifeline is not None:
            self._lifeline.close()
            self._lifeline = None
        if self._folder is not None:
            self._folder.cleanup()
            self._folder = None
        self._process = None
