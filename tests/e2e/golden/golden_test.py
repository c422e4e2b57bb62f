# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""What the programs print is what it was: a change of an output is a change of a file here.

golden_test.py exact|live REPOSITORY BIN_DIR [--update] [--keep DIR]. --update writes the files,
--keep leaves all outputs in DIR, whole, to compare those of two builds. See docs/design/tests.md.
"""

import argparse
import difflib
import sys
import tempfile
from pathlib import Path

import exact
import live
from normal import exact as exactly
from normal import masked, page_of
from programs import Programs

here = Path(__file__).resolve().parent


def normal(output, seen):
    """Its text, the same in every run."""
    if output.form == "shape":
        return output.text
    if output.form != "page":
        return exactly(output.text, output.form, seen)
    page, data = page_of(output.text)
    parts = [masked(page)]
    for name, text in data.items():
        parts.append(f"-- data {name}\n{exactly(text, 'json', seen)}")
    return "".join(parts)


def texts_of(outputs, keep):
    """The text of each golden file."""
    texts, seen = {}, {}
    for name, output in outputs:
        if output.text is None:
            print(f"left out: {name} cannot run here")
            texts[name] = None
            continue
        text = normal(output, seen.setdefault(name, {}))
        if output.label == "stderr" and not text:
            continue
        texts[name] = texts.get(name, "") + f"== {output.label}\n{text.rstrip()}\n"
        if keep:
            with open(keep / f"{name}.whole", "a", encoding="utf-8") as file:
                file.write(f"== {output.label}\n{output.whole or output.text}\n")
    return texts


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("kind", choices=("exact", "live"))
    parser.add_argument("repository", type=Path)
    parser.add_argument("bin", type=Path)
    parser.add_argument("--update", action="store_true")
    parser.add_argument("--keep", type=Path)
    arguments = parser.parse_args()
    folder = here / arguments.kind
    with tempfile.TemporaryDirectory() as place:
        programs = Programs(arguments.bin, place)
        try:
            kind = exact if arguments.kind == "exact" else live
            texts = texts_of(kind.outputs(programs, arguments.repository), arguments.keep)
        finally:
            programs.stop_all()
    wrong = 0
    for name in sorted(texts.keys() | {path.stem for path in folder.glob("*.txt")}):
        path = folder / f"{name}.txt"
        before = path.read_text(encoding="utf-8") if path.exists() else ""
        after = texts.get(name, "")
        if after in (before, None):
            continue
        wrong += 1
        sys.stdout.writelines(difflib.unified_diff(
            before.splitlines(True), after.splitlines(True), f"{path.relative_to(here)}",
            "what the programs print"))
        if arguments.update:
            folder.mkdir(exist_ok=True)
            path.write_text(after, encoding="utf-8")
    print(f"{len(texts)} golden files, {wrong} {'written' if arguments.update else 'differ'}")
    return 1 if wrong and not arguments.update else 0


if __name__ == "__main__":
    sys.exit(main())
