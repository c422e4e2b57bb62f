# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""What the programs print is what it was: a change of an output is a change of a file here. And it
is as the JSON Schemas say, where the module jsonschema is there to look.

golden_test.py exact|live REPOSITORY BIN_DIR [--update] [--keep DIR]. --update writes the files,
--keep leaves all outputs in DIR, whole, to compare those of two builds. See docs/design/tests.md.
"""

import argparse
import difflib
import importlib.util
import sys
import tempfile
from pathlib import Path

import exact
import live
from normal import exact as exactly
from normal import masked, page_of
from programs import Programs

here = Path(__file__).resolve().parent
# The schemas of which the outputs of each kind have at least a document.
SCHEMAS = {
    "exact": ["analysis", "comparison", "explanation", "fitted-hands", "hands", "learn", "manifest",
              "plan", "play", "prediction", "replay", "sessions", "tables", "verification"],
    "live": ["analysis", "doctor", "emulator", "emulator-frame", "events", "peer", "peer-frame",
             "probe", "self-test"]}


def checked_by_schemas(folder):
    """Those of the programs in this folder; None without the module."""
    if importlib.util.find_spec("jsonschema") is None:
        print("the schemas are left out: the module jsonschema is missing "
              "(Debian: python3-jsonschema)")
        return None
    sys.path.insert(0, str(here.parent / "schemas"))
    from checked import Checked
    return Checked(folder)


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


def texts_of(outputs, keep, checked):
    """The text of each golden file. Each output is held against its schema."""
    texts, seen = {}, {}
    for name, output in outputs:
        if output.text is None:
            print(f"left out: {name} cannot run here")
            texts[name] = None
            continue
        if checked:
            checked.take(output)
        text = normal(output, seen.setdefault(name, {}))
        if output.label == "stderr" and not text:
            continue
        texts[name] = texts.get(name, "") + f"== {output.label}\n{text.rstrip()}\n"
        if keep:
            with open(keep / f"{name}.whole", "a", encoding="utf-8") as file:
                file.write(f"== {output.label}\n{output.whole or output.text}\n")
    return texts


def faults_of(checked, names):
    """Prints what is not as the schemas say, and which of these names no document has; how many."""
    checked.refuses_all_broken()
    faults = checked.faults + [f"no document is validated by {name}"
                               for name in checked.missing(names)]
    for fault in faults:
        print("FAULT", fault)
    print(f"{checked.count} documents validated")
    return len(faults)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("kind", choices=("exact", "live"))
    parser.add_argument("repository", type=Path)
    parser.add_argument("bin", type=Path)
    parser.add_argument("--update", action="store_true")
    parser.add_argument("--keep", type=Path)
    arguments = parser.parse_args()
    folder = here / arguments.kind
    checked = checked_by_schemas(arguments.bin)
    with tempfile.TemporaryDirectory() as place:
        programs = Programs(arguments.bin, place)
        try:
            kind = exact if arguments.kind == "exact" else live
            texts = texts_of(kind.outputs(programs, arguments.repository), arguments.keep, checked)
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
    faults = faults_of(checked, SCHEMAS[arguments.kind]) if checked else 0
    return 1 if faults or (wrong and not arguments.update) else 0


if __name__ == "__main__":
    sys.exit(main())
