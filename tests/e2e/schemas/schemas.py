# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Validates what the programs write against the schemas that they print.

As a program: schemas.py BIN_DIR FOLDER... validates all JSON in these folders, each file by the
schema that its name stands for; one that stands for none is a fault. The build has written the
schemas into a folder beside that of the programs, BIN_DIR. Exits 1 with faults, and 77 without the
module jsonschema. Keys that a schema does not list are faults here, though not to its users: later
versions may add some.
"""

import json
import re
import sys
import warnings
from pathlib import Path

try:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # of newer versions: Debian 12 has 4.10
        from jsonschema import Draft202012Validator, RefResolver
except ImportError:
    print("skipped: the module jsonschema is missing (Debian: python3-jsonschema)")
    sys.exit(77)

repository = Path(__file__).resolve().parents[3]

# The schema of a file in a folder of results, by the end of its path.
of_files = [(r"(seen|unseen|simulated)/manifest\.json", "hands"), (r"manifest\.json", "manifest"),
            (r"(results|sessions|real_time)\.json", "tables"), (r"fit\.json", "fitted-hands"),
            (r"analysis\.json", "analysis"), (r"emulator\.json", "emulator"),
            (r"peer-\d+\.json", "peer"), (r"plan\.json", "plan"),
            (r"(sessions|\d+-of-\d+)\.jsonl", "sessions"), (r"result\.json", "attempt"),
            (r"peer-\d+-events\.jsonl", "events")]


def schema_name_of(path):
    """The name of the schema that a path stands for; None where it stands for none."""
    return next((name for pattern, name in of_files
                 if re.search(f"(^|/){pattern}$", str(path))), None)


def strict(schema):
    """The same schema, to which keys that it does not list are errors."""
    if isinstance(schema, list):
        return [strict(one) for one in schema]
    if not isinstance(schema, dict):
        return schema
    copy = {key: strict(value) for key, value in schema.items()}
    if "properties" in copy and "additionalProperties" not in copy:
        copy["additionalProperties"] = False
    return copy


def schema_folder(programs):
    """Where the build has written what the programs of this folder print."""
    return Path(programs).resolve().parent / "schemas"


def read_schemas(programs):
    """All that these programs print and that of the benches, by name; each may refer to the others
    by the names of their files."""
    base, suffix = "file:///schemas/", ".schema.json"  # which are read here, not there
    files = {}
    for path in [*sorted(schema_folder(programs).glob("*" + suffix)),
                 repository / "docs/formats/schemas/bench.schema.json"]:
        schema = json.loads(path.read_text())
        Draft202012Validator.check_schema(schema)
        files[base + path.name] = strict(schema)
    return {url.removeprefix(base).removesuffix(suffix):
            Draft202012Validator(schema, resolver=RefResolver(url, schema, store=files))
            for url, schema in files.items()}


def faults_in(validator, document):
    """What keeps a document from being as the schema of this validator says."""
    faults = []
    for error in validator.iter_errors(document):
        # If several forms fail, the one that fits best is reported.
        while error.context:
            forms = {}
            for one in error.context:
                forms.setdefault(one.schema_path[0], []).append(one)
            error = min(forms.values(), key=len)[0]
        faults.append(f"{'.'.join(map(str, error.absolute_path))}: {error.message[:200]}")
    return faults


def faults_in_file(validators, path):
    """Likewise for a file, line by line where it is one of lines; and how many it has."""
    name = schema_name_of(path)
    if name is None:
        return [f"{path}: no schema is for files of this name"], 0
    text = path.read_text()
    parts = text.splitlines() if path.suffix == ".jsonl" else [text]
    faults = [f"{path}: {fault}" for part in parts
              for fault in faults_in(validators[name], json.loads(part))]
    return faults, len(parts)


def faults_in_folder(validators, folder):
    """Likewise for all of a folder; and how many documents it has."""
    faults, documents = [], 0
    for path in sorted(Path(folder).rglob("*.json*")):
        found, count = faults_in_file(validators, path)
        faults += found
        documents += count
    return faults, documents


if __name__ == "__main__":
    schemas = read_schemas(sys.argv[1])
    for folder in sys.argv[2:]:
        found, documents = faults_in_folder(schemas, folder)
        for fault in found:
            print("FAULT", fault)
        if found or documents == 0:
            sys.exit(f"{folder}: {len(found)} faults in {documents} documents")
        print(f"{folder}: {documents} documents validated")
