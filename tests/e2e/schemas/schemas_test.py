# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""What the programs write is as the JSON Schemas say, and the schemas know all of it.

The programs are run as for the golden files (tests/e2e/golden).

schemas_test.py REPOSITORY BIN_DIR. Without jsonschema it is left out.
"""

import json
import re
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

from schemas import faults_in, of_files, read_schemas, schema_folder

repository, folder = Path(sys.argv[1]), Path(sys.argv[2])
sys.dont_write_bytecode = True
sys.path.insert(0, str(repository / "tests/e2e/golden"))
import exact  # noqa: E402
import live  # noqa: E402
from programs import Programs  # noqa: E402

validators = read_schemas(folder)
faults = []
validated = 0
documents = {}  # by the names of their schemas


def validate(name, document, label):
    global validated
    validated += 1
    documents.setdefault(name, []).append(document)
    faults.extend(f"{label}: {fault}" for fault in faults_in(validators[name], document))


def refuses(name, document, label):
    if validators[name].is_valid(document):
        faults.append(f"{name} accepts {label}")


def broken(name, document, form=None):
    """Documents that differ from a good one in one place. `form`: which of several it has."""
    schema = validators[name].schema
    required = [*schema.get("required", []), *(form or {}).get("required", [])]
    assert required
    for key in required:
        refuses(name, {k: v for k, v in document.items() if k != key}, f"one without {key}")
        refuses(name, {**document, key: {"no": ["such"]}}, f"an object of other keys as {key}")
    refuses(name, {**document, "no_such_key": 1}, "a key that is not listed")


def schema_of(output):
    """The one that it says, or that its name as a file stands for."""
    file = Path(output.label).name
    return output.schema or next(
        (schema for pattern, schema in of_files if re.fullmatch(pattern, file)), None)


# All that the golden files have.
with tempfile.TemporaryDirectory() as place:
    programs = Programs(folder, place)
    try:
        for kind in (exact, live):
            for _, output in kind.outputs(programs, repository):
                schema, text = schema_of(output), output.whole or output.text
                if schema is None or text is None:
                    continue
                lines = schema in ("events", "sessions", "emulator-frame", "peer-frame")
                for document in text.splitlines() if lines else [text]:
                    validate(schema, json.loads(document), output.label)
    finally:
        programs.stop_all()

# The build has written the schemas that the programs print, and each names its subject.
names = {"statistics": "{}", "frame": "{}-frame", "predict": "prediction", "verify": "verification"}
printed = set()
for program in ("emulator", "peer", "lab"):
    def schema_printed(word, program=program):
        return subprocess.run([Path(folder) / f"hapnet-{program}", "schema", word], check=True,
                              capture_output=True, text=True).stdout

    for line in schema_printed("--list").splitlines():
        name, title = line.split(maxsplit=1)
        file = names.get(name, name).format(program)
        printed.add(file)
        text = schema_printed(name)
        if text != (schema_folder(folder) / f"{file}.schema.json").read_text():
            faults.append(f"hapnet-{program} schema {name} is not {file}.schema.json")
        if json.loads(text)["title"] != title:
            faults.append(f"hapnet-{program} schema --list calls {name} '{title}'")
if rest := validators.keys() - printed - {"bench"}:
    faults.append(f"no program prints the schemas {rest}")
by_hand = (repository / "docs/formats/schemas").glob("*.json")
others = {"bench", "study", "study-answers"}  # of tests/e2e/study
if rest := {path.name.split(".")[0] for path in by_hand} - printed - others:
    faults.append(f"no program has the schemas {rest} of the docs")

forms = {"manifest": validators["manifest"].schema["$defs"]["experiment"],
         "sessions": validators["sessions"].schema["oneOf"][0]}
for name, found in documents.items():
    broken(name, found[0], forms.get(name))
several = [one for one in documents["manifest"] if one["kind"] == "several"]
broken("manifest", several[0], validators["manifest"].schema["$defs"]["several"])
broken("sessions", documents["sessions"][1], validators["sessions"].schema["oneOf"][1])

# Profiles: all that are shipped, those of the page that are whole, and each law of its tables.
for path in sorted((repository / "scripts/profiles").glob("*.toml")):
    validate("profile", tomllib.loads(path.read_text()), path.name)
page = (repository / "docs/formats/profile.md").read_text()
for text in re.findall(r"```toml\n(.*?)```", page, re.DOTALL):
    validate("profile", tomllib.loads(text), text)
examples = {"a time": "5ms", "a share": "1%", "a size": "64KiB", "a rate": "10Mbit/s",
            "a whole": 2, "a number": 3, "true": True, "a list: each": [1, 2],
            "a list of times": [["1s", "2s"]], "a text of 0": "0010", "a text": "x.csv"}


def example(value):
    if value.startswith("`"):
        return re.findall(r'"([^"]+)"', value)[0]
    return next(sample for start_, sample in examples.items() if value.startswith(start_))


def table(name):
    text = page[page.index(f"<!-- keys: {name} -->"):]
    rows = [line.strip("|").split(" | ") for line in text[:text.index("<!-- end")].splitlines()
            if line.startswith("| `")]
    return [[cell.strip() for cell in row] for row in rows]


for kind, key in (("delay-laws", "jitter"), ("loss-laws", "loss")):
    laws = {}
    for law, name, value, *_ in table(kind):
        laws.setdefault(law.strip("`"), {})[name.strip("`")] = example(value)
    assert len(laws) > 5
    for law, parameters in laws.items():
        whole = {"law": law, **parameters}
        validate("profile", {"both": {key: whole}}, f"{key} {law}")
        refuses("profile", {"both": {key: {**whole, "no_such": 1}}}, f"{law} with another key")
for bad in ({"both": {"delay": 40}}, {"both": {"delay": "40"}}, {"both": {"dealy": "40ms"}},
            {"both": {"loss": "2"}}, {"at": [{"both": {"delay": "1ms"}}]}, {"seed": "1"},
            {"both": {"order": "any"}}):
    refuses("profile", bad, str(bad))

# The rows of the benches: those of all are made by functions with these keys.
sys.path.insert(0, str(repository / "tests/bench/web"))
import rows  # noqa: E402

place = {"case": "c", "subject": "s", "baseline": "b"}
validate("bench", {"host": {"cpu": "a"}, "rows": [
    rows.row(place, "missed_ticks", 0, baseline_value=0, target=0), rows.row(place, "frames", 3),
    rows.row(place, "late_ratio", 0, baseline_value=1, target=2, direction="min")]}, "bench")

# Other tests have documents of the other schemas, such as attempts (scripts/real-time.sh).
if unused := validators.keys() - documents.keys() - {"attempt"}:
    faults.append(f"no document is validated by {unused}")
print(f"{validated} documents validated")
for fault in faults:
    print("FAULT", fault)
sys.exit(1 if faults or validated < 150 else 0)
