# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""The schemas that the programs print are those of the build, and those of profiles and benches are
right. The golden files (tests/e2e/golden) check the others by what the programs write.

schemas_test.py REPOSITORY BIN_DIR. Without jsonschema it is left out.
"""

import json
import re
import subprocess
import sys
import tomllib
from pathlib import Path

from checked import Checked
from schemas import schema_folder

repository, folder = Path(sys.argv[1]), Path(sys.argv[2])
sys.dont_write_bytecode = True
checked = Checked(folder)
validators, faults = checked.validators, checked.faults

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

# Profiles: all that are shipped, those of the page that are whole, and each law of its tables.
for path in sorted((repository / "scripts/profiles").glob("*.toml")):
    checked.validate("profile", tomllib.loads(path.read_text()), path.name)
page = (repository / "docs/formats/profile.md").read_text()
for text in re.findall(r"```toml\n(.*?)```", page, re.DOTALL):
    checked.validate("profile", tomllib.loads(text), text)
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
        checked.validate("profile", {"both": {key: whole}}, f"{key} {law}")
        checked.refuses("profile", {"both": {key: {**whole, "no_such": 1}}},
                        f"{law} with another key")
for bad in ({"both": {"delay": 40}}, {"both": {"delay": "40"}}, {"both": {"dealy": "40ms"}},
            {"both": {"loss": "2"}}, {"at": [{"both": {"delay": "1ms"}}]}, {"seed": "1"},
            {"both": {"order": "any"}}):
    checked.refuses("profile", bad, str(bad))

# The rows of the benches: those of all are made by functions with these keys.
sys.path.insert(0, str(repository / "tests/bench/web"))
import rows  # noqa: E402

place = {"case": "c", "subject": "s", "baseline": "b"}
checked.validate("bench", {"host": {"cpu": "a"}, "rows": [
    rows.row(place, "missed_ticks", 0, baseline_value=0, target=0), rows.row(place, "frames", 3),
    rows.row(place, "late_ratio", 0, baseline_value=1, target=2, direction="min")]}, "bench")

checked.refuses("bench", {"host": {"cpu": "a"}}, "no rows")
print(f"{checked.count} documents validated")
for fault in faults:
    print("FAULT", fault)
sys.exit(1 if faults or checked.count < 50 else 0)
