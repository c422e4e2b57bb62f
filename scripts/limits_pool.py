#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""The published limits of Fig. 6, by a pool of fresh seeds: docs/results/data/limits.json.

    scripts/limits_pool.py data DIR     prints that file from what limits_pool.sh left in DIR
    scripts/limits_pool.py agree DIR    says whether the limits in DIR/limits.csv agree with it

The pool's limit is the mean of the limits of its ranges, which are independent. Its 95 % interval
is Student's, of the spread between them. A limit beyond the search has no interval.

Two limits agree where their difference is within both 95 % intervals: within the root of the sum of
the squares of their half widths. One in twenty may lie beyond by chance. Exits 0 also then.
"""
import csv
import json
import math
import pathlib
import statistics
import sys

sys.dont_write_bytecode = True
import data_rows  # noqa: E402

DATA = pathlib.Path(__file__).resolve().parent.parent / "docs" / "results" / "data" / "limits.json"
KEYS = ("algorithm", "impairment", "task", "p50", "ci_low", "ci_high", "bound", "unit", "seeds",
        "decided_by")
NUMBERS = ("p50", "ci_low", "ci_high", "seeds")
UNITS = {"ms": "ms", "percent": "%", "of_100": "of 100"}
# Student's t at 97.5 % by degrees of freedom, from 1 on.
STUDENT = (12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179)


def limits_in(path):
    """The rows of a limits.csv."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = [{key: row[key] for key in KEYS} for row in csv.DictReader(file)]
    for row in rows:
        for key in NUMBERS:
            row[key] = float(row[key]) if row[key] else None
    return rows


def pool_of(ranges):
    """A row for each limit, from its rows in at least two ranges."""
    limits = {}
    for one in ranges:
        for row in one["limits"]:
            limits.setdefault((row["algorithm"], row["impairment"]), []).append(row)
    for rows in limits.values():
        values = [row["p50"] for row in rows]
        bounded = [row["p50"] for row in rows if row["bound"] == ">"]
        is_bounded = bool(bounded)
        degrees = min(len(values) - 1, len(STUDENT))
        half = STUDENT[degrees - 1] * statistics.stdev(values) / math.sqrt(len(values))
        mean = statistics.mean(values)
        if is_bounded:  # The limits of some ranges are above what they state.
            mean = min(values)
        yield {**rows[0], "p50": round(mean, 2), "bound": ">" if is_bounded else "=",
               "ci_low": None if is_bounded else round(mean - half, 2),
               "ci_high": None if is_bounded else round(mean + half, 2),
               "least": min(values), "largest": max(values),
               "seeds": sum(row["seeds"] for row in rows),
               "decided_by": statistics.mode(row["decided_by"] for row in rows)}


def rows_of(ranges):
    """Those of scripts/result_tables.py: the pool, and the least and the largest of its ranges."""
    limits = list(pool_of(ranges))
    for impairment in dict.fromkeys(one["impairment"] for one in limits):
        of_impairment = [one for one in limits if one["impairment"] == impairment]
        case = f"{impairment.replace('-', ' ')}, {UNITS[of_impairment[0]['unit']]}"
        for metric, key in (("limit", "p50"), ("95 % from", "ci_low"),
                            ("95 % to", "ci_high"), ("least", "least"),
                            ("largest", "largest")):
            for one in of_impairment:
                if one["bound"] == "=":
                    yield data_rows.row(case, one["algorithm"], metric, one[key])
        for one in of_impairment:
            if one["bound"] == ">":
                yield data_rows.row(case, one["algorithm"], "limit above", one["p50"])


def print_data(folder):
    manifest = json.loads((folder / "manifest.json").read_text(encoding="utf-8"))
    ranges = []
    for path in sorted(folder.glob("range-*.csv")):
        rows = [row for row in limits_in(path) if row["task"] == "worst"]
        ranges.append({"first_seed": int(path.stem.split("-")[1]), "limits": rows})
    data_rows.print_file(
        {"about": "Limits of Fig. 6 by fresh seeds: means over ranges of 40, and the ranges.",
         **data_rows.head(manifest, "scripts/limits_pool.sh"),
         "seeds": {"first": ranges[0]["first_seed"], "count": 40 * len(ranges)}},
        rows=rows_of(ranges), ranges=ranges)


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
        print_data(folder)
        return 0
    pool = list(pool_of(json.loads(DATA.read_text(encoding="utf-8"))["ranges"]))
    lines = list(agreement(limits_in(folder / "limits.csv"), pool))
    for _, line in lines:
        print(line)
    if lines:
        print(f"{sum(fine for fine, _ in lines)} of {len(lines)} limits agree with the pool")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
