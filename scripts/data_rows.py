#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""A table of results as a data file of scripts/result_tables.py.

    scripts/data_rows.py DIR TABLE --case KEYS --subject KEY --metrics KEYS [--where KEY=VALUE]...
                         [--command WORDS]

DIR is a folder of results that `hapnet-lab run` has written; its results.json holds TABLE. Each row
of the table gives a row for each metric. Its case has the values of the keys of --case, its subject
that of --subject. --where takes the rows with that value. Keys have commas between them. --command
names how the results were made (default: as their manifest does). Prints the file. Exits 2 where
the table or a key is missing.

    scripts/data_rows.py results/qos requirements --case tier --subject algorithm \\
        --metrics delay_ms,loss_percent --where task=worst >docs/results/data/requirements.json
"""
import argparse
import json
import pathlib
import sys


def refuse(words):
    print(f"data_rows: {words}", file=sys.stderr)
    sys.exit(2)


def read(path):
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        return refuse(f"{path}: {error.strerror}: name a folder of results")
    except ValueError as error:
        return refuse(f"{path}: {error}: run the experiment again")


def records(folder, name):
    """The rows of a table as objects."""
    tables = read(folder / "results.json")["tables"]
    if name not in tables:
        refuse(f"{folder} has no table {name}: it has {', '.join(tables)}")
    keys = [column["key"] for column in tables[name]["columns"]]
    return keys, [dict(zip(keys, row)) for row in tables[name]["rows"]]


def row(case, subject, metric, value, target=None):
    """A row without a baseline. A target is the most that the value may be."""
    return {"case": case, "subject": subject, "baseline": None, "metric": metric, "value": value,
            "baseline_value": None, "ratio": None, "target": target, "direction": "max",
            "met": None if target is None else value <= target}


def head(manifest, command):
    """What comes before the rows: who made them, by the manifest of a folder of results."""
    return {"commit": manifest["commit"], "date": manifest["start"][:10],
            "machine": f"{manifest['host']['processors']} processors", "command": command}


def print_file(of_head, **lists):
    """Prints a data file, with a line for each element of these lists, such as rows=[...]."""
    print(json.dumps(of_head)[:-1], end="")
    for name, elements in lists.items():
        print(f', "{name}": [')
        print(",\n".join("  " + json.dumps(one) for one in elements))
        print("]", end="")
    print("}")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, metavar="DIR")
    parser.add_argument("table", metavar="TABLE")
    for option in ("--case", "--subject", "--metrics"):
        parser.add_argument(option, required=True)
    parser.add_argument("--where", action="append", default=[], metavar="KEY=VALUE")
    parser.add_argument("--command")
    options = parser.parse_args()
    keys, table = records(options.folder, options.table)
    wanted = dict(words.partition("=")[::2] for words in options.where)
    case, metrics = options.case.split(","), options.metrics.split(",")
    for key in (*case, options.subject, *metrics, *wanted):
        if key not in keys:
            refuse(f"{options.table} has no key {key}: it has {', '.join(keys)}")
    rows = [row(", ".join(str(one[key]) for key in case), one[options.subject], metric, one[metric])
            for one in table if all(str(one[key]) == value for key, value in wanted.items())
            for metric in metrics if one[metric] is not None]
    if not rows:
        refuse(f"no row of {options.table} is as --where says")
    manifest = read(options.folder / "manifest.json")
    print_file(head(manifest, options.command or manifest["command"]), rows=rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
