# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Holds what the programs wrote against the schemas, and the schemas against broken documents."""

import json

from schemas import faults_in, read_schemas, schema_name_of


class Checked:
    """The documents of a run, each validated by its schema."""

    def __init__(self, programs):
        self.validators = read_schemas(programs)
        self.documents = {}  # by the names of their schemas
        self.faults = []

    @property
    def count(self):
        return sum(map(len, self.documents.values()))

    def validate(self, name, document, label):
        self.documents.setdefault(name, []).append(document)
        self.faults += [f"{label}: {fault}" for fault in faults_in(self.validators[name], document)]

    def take(self, output):
        """What a program printed or wrote, by the schema that it says, or that its path stands
        for."""
        name, text = output.schema or schema_name_of(output.label), output.whole or output.text
        if name is None or text is None:
            return
        is_lines = name in ("events", "sessions", "emulator-frame", "peer-frame")
        for document in text.splitlines() if is_lines else [text]:
            self.validate(name, json.loads(document), output.label)

    def refuses(self, name, document, label):
        if self.validators[name].is_valid(document):
            self.faults.append(f"{name} accepts {label}")

    def refuses_broken(self, name, document, form=None):
        """Documents that differ from a good one in one place. `form`: which of several it has."""
        schema = self.validators[name].schema
        required = [*schema.get("required", []), *(form or {}).get("required", [])]
        assert required, name
        for key in required:
            self.refuses(name, {k: v for k, v in document.items() if k != key},
                         f"one without {key}")
            self.refuses(name, {**document, key: {"no": ["such"]}},
                         f"an object of other keys as {key}")
        self.refuses(name, {**document, "no_such_key": 1}, "a key that is not listed")

    def refuses_all_broken(self):
        """Breaks one document of each schema, and of each of the forms of some."""
        manifest = self.validators["manifest"].schema["$defs"]
        sessions = self.validators["sessions"].schema["oneOf"]
        several_forms = {"manifest": [(lambda one: one["kind"] == "several", manifest["several"]),
                                      (lambda one: "speed_ratio" in one, manifest["experiment"])],
                         "sessions": [(lambda one: "key" in one, sessions[1]),
                                      (lambda one: "format" in one, sessions[0])]}
        for name, documents in self.documents.items():
            for is_form, form in several_forms.get(name, [(lambda one: True, None)]):
                found = next((one for one in documents if is_form(one)), None)
                if found is not None:
                    self.refuses_broken(name, found, form)

    def missing(self, names):
        """The schemas of these names by which nothing was validated."""
        return sorted(set(names) - self.documents.keys())
