#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""The published limits of Fig. 6, by a pool of fresh seeds: docs/results/data/limits.json.

    scripts/limits_pool.py data DIR     prints that file from what limits_pool.sh left in DIR
    scripts/limits_pool.py agree DIR    says whether the limits in DIR/limits.csv agree with it

Two limits agree where their difference is within both 95 % intervals: within the root of the sum of
the squares of their half widths. One in twenty may lie beyond by chance. Exits 0 also then.
"""
import csv
import json
import math
import pathlib
import sys

DATA = pathlib.Path(__file__).resolve().parent.parent / "docs" / "results" / "data" / "limits.json"
KEYS = ("algorithm", "impairment", "task", "p50", "ci_low", "ci_high", "bound", "unit", "seeds",
        "decided_by")
NUMBERS = ("p50", "ci_low", "ci_high", "seeds")


def limits_in(path):
    """The rows of a limits.csv."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = [{key: row[key] for key in KEYS} for row in csv.DictReader(file)]
    for row in rows:
        for key in NUMBERS:
            row[key] = float(row[key]) if row[key] else None
    return rows


def data_of(folder):
    manifest = json.loads((folder / "manifest.json").read_text(encoding="utf-8"))
    ranges = []
    for path in sorted(folder.glob("range-*.csv")):
        rows = [row for row in limits_in(path) if row["task"] == "worst"]
        ranges.append({"first_seed": int(path.stem.split("-")[1]), "limits": rows})
    host = manifest["host"]
    return {"about": "Limits of Fig. 6 by fresh seeds: all of them together, and by ranges of 40.",
            "commit": manifest["commit"], "date": manifest["start"][:10],
            "machine": f"{host['processors']} processors, {host['machine']}, {host['system']}",
            "command": "scripts/limits_pool.sh",
            "seeds": {"first": manifest["seeds"][0], "count": len(manifest["seeds"])},
            "pool": limits_in(folder / "limits.csv"), "ranges": ranges}


def half_width(row):
    """Of the interval; infinite where it is open."""
    if row["ci_low"] is None or row["ci_high"] is None:
        return math.inf
    return (row["ci_high"] - row["ci_low"]) / 2


def agreement(rows, pool):
    """A line for each limit that both have."""
    for row in rows:
        if row["task"] != "worst":
            continue
        key = (row["algorithm"], row["impairment"], "worst")
        published = [one for one in pool
                     if (one["algorithm"], one["impairment"], one["task"]) == key]
        if not published:
            continue
        other = published[0]
        name = f"{row['algorithm']}, {row['impairment']}"
        said = f"{row['p50']:g} {row['unit']}, the pool {other['p50']:g}"
        if row["bound"] == ">" or other["bound"] == ">":
            fine = row["bound"] == other["bound"]
        else:
            apart = abs(row["p50"] - other["p50"])
            fine = apart <= math.hypot(half_width(row), half_width(other))
        yield fine, f"{name}: {said}: {'agrees' if fine else 'beyond both intervals'}"


def main(arguments):
    if len(arguments) != 2 or arguments[0] not in ("data", "agree"):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    folder = pathlib.Path(arguments[1])
    if arguments[0] == "data":
        print(json.dumps(data_of(folder), indent=1))
        return 0
    pool = json.loads(DATA.read_text(encoding="utf-8"))["pool"]
    lines = list(agreement(limits_in(folder / "limits.csv"), pool))
    for _, line in lines:
        print(line)
    if lines:
        print(f"{sum(fine for fine, _ in lines)} of {len(lines)} limits agree with the pool")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
