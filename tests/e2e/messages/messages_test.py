#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Each mistake in mistakes.json is answered with its exit code, and with words that name place,
reason and cure. HAPNET_BIN is the folder of the programs, HAPNET_REPOSITORY that of the sources."""

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

BIN = Path(os.environ["HAPNET_BIN"])
HERE = Path(__file__).resolve().parent
NOBODY = 65534


def words_of(row, places):
    """The words of a row as the system takes them."""
    words = [word.format(**places) if "{" in word and "}" in word and word[0] == "{" else word
             for word in row["words"]]
    if words[0] == "python":
        return [sys.executable, "-c", *words[1:]]
    if row.get("script"):
        return words[1:]
    return [str(BIN / words[0]), *words[1:]]


def environment_of(row):
    """The variables of this test with those of a row; null: not set."""
    variables = dict(os.environ, LC_ALL="C")
    for name, value in row.get("environment", {}).items():
        variables.pop(name, None)
        if value is not None:
            variables[name] = value
    return variables


def may_run_as_nobody(program):
    """Whether an ordinary user reaches the program, when root runs this test."""
    if os.geteuid() != 0:
        return True
    try:
        tried = subprocess.run([program, "--version"], user=NOBODY, group=NOBODY, extra_groups=[],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    except OSError:
        return False
    return tried.returncode == 0


def why_skipped(row):
    """Why a row says nothing here; empty: it does."""
    program = row["words"][0]
    if program.startswith("hapnet-") and not (BIN / program).exists():
        return f"{program} is not built"
    if row.get("user") == "ordinary" and not may_run_as_nobody(BIN / program):
        return "an ordinary user cannot run the programs from their folder"
    if row.get("needs") == "user namespaces":
        tried = subprocess.run([BIN / "hapnet-emulator", "between", "--", "/bin/true", "---",
                                "/bin/true"], stdin=subprocess.DEVNULL, capture_output=True,
                               timeout=30, check=False)
        if b"namespace" in tried.stderr:
            return "this system lets no program make a network of its own"
    return ""


def emulator_in(folder):
    """An emulator with a control socket, and the process that it is."""
    process = subprocess.Popen(
        [BIN / "hapnet-emulator", "--listen", "127.0.0.1:0", "--upstream", "127.0.0.1:9",
         "--control", "emulator.sock"], cwd=folder, stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    process.stdout.readline()
    return process


def complaints_of(row):
    """What is wrong with the answer to the mistake of a row."""
    with tempfile.TemporaryDirectory(prefix="hapnet-messages-") as name:
        folder = Path(name)
        folder.chmod(0o755)
        locked = folder / "locked"
        locked.mkdir(mode=0o555)
        for file, text in row.get("files", {}).items():
            (folder / file).write_text(text, encoding="utf-8")
        places = {"locked": str(locked), "repository": os.environ["HAPNET_REPOSITORY"]}
        emulator = emulator_in(folder) if row.get("emulator") else None
        as_nobody = row.get("user") == "ordinary" and os.geteuid() == 0
        user = {"user": NOBODY, "group": NOBODY, "extra_groups": []} if as_nobody else {}
        try:
            done = subprocess.run(words_of(row, places), cwd=folder, env=environment_of(row),
                                  stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                  stderr=subprocess.PIPE, timeout=30, check=False, **user)
        except subprocess.TimeoutExpired:
            return ["it was not refused within 30 s"]
        finally:
            if emulator is not None:
                emulator.terminate()
                emulator.wait()
        said = done.stderr.decode(errors="replace")
        wrong = []
        if done.returncode != row["code"]:
            wrong.append(f"exit code {done.returncode}, not {row['code']}")
        for part in row["says"]:
            if part.replace("{locked}", str(locked)) not in said:
                wrong.append(f"it does not say: {part}")
        for part in row.get("never_says", []):
            if part in said:
                wrong.append(f"it says: {part}")
        return [*wrong, f"it said: {said.strip()[:500]}"] if wrong else []


def main():
    """Tries all mistakes, and tells of those that are answered otherwise."""
    rows = json.loads((HERE / "mistakes.json").read_text(encoding="utf-8"))
    names = [row["name"] for row in rows]
    assert len(set(names)) == len(names), "each mistake has a name of its own"
    failed = skipped = 0
    for row in rows:
        reason = why_skipped(row)
        if reason:
            skipped += 1
            print(f"skipped: {row['name']}: {reason}")
            continue
        wrong = complaints_of(row)
        failed += bool(wrong)
        for complaint in wrong:
            print(f"{row['name']}: {complaint}")
    print(f"{len(rows)} mistakes, {skipped} skipped, {failed} answered otherwise")
    return 1 if failed or skipped == len(rows) else 0


if __name__ == "__main__":
    sys.exit(main())
