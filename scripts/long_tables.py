#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""The long tables of the experiments: docs/results/data/long-tables.json.

    scripts/long_tables.py DIR >FILE

DIR is what `scripts/reproduce.sh --all --out DIR` has left. The file is one of
scripts/result_tables.py. It has limits by hand and by the order of the filter, limits by other
readings of the paper, how many networks an algorithm bears, the delay that two to five hands bear,
and the errors of the tick. A limit is that of the task with the lowest one. A limit without an
interval is the most that was tried. Exits 2 where one of the experiments is missing.
"""
import argparse
import collections
import csv
import itertools
import json
import pathlib
import sys

sys.dont_write_bytecode = True
import data_rows  # noqa: E402

UNITS = {"ms": "ms", "percent": "%", "of_100": "of 100"}
ORDERS = {"1": "", "2": ", second order", "4": ", fourth order"}
# The experiments over an axis: the word of a row for each of them.
READINGS = {"velocity-rule": "velocity", "horizon": "horizon", "jitter-order": "jitter order",
            "path-delay": "path"}
TIERS = {"usable": ("usable", "good"), "good": ("good",)}


def text_of(path):
    try:
        return path.read_text(encoding="utf-8")
    except OSError as error:
        print(f"long_tables: {path}: {error.strerror}: run scripts/reproduce.sh --all --out DIR",
              file=sys.stderr)
        sys.exit(2)


def rows_in(path):
    return list(csv.DictReader(text_of(path).splitlines()))


def number(text):
    return float(text) if text else None


def impairment(row):
    return f"{row['impairment'].replace('-', ' ')}, {UNITS[row['unit']]}"


def convention_rows(folder):
    """Of all tasks the lowest limit, by hand and order of the filter."""
    lowest = {}
    for name in ("fig6a", "fig6b"):
        for row in rows_in(folder / name / "limits_by_convention.csv"):
            key = (row["algorithm"], impairment(row), row["hand"] + ORDERS[row["filter_order"]])
            lowest[key] = min(lowest.get(key, row), row, key=lambda one: float(one["limit"]))
    for (algorithm, what, hand), row in lowest.items():
        if row["bound"] == "=" and (row["filter_order"] == "1" or row["hand"] == "nominal"):
            yield data_rows.row(f"by hand: {algorithm}", hand, what, float(row["limit"]))


def reading_rows(folder):
    for name, word in READINGS.items():
        for row in rows_in(folder / name / "limits_by_axis.csv"):
            if row["task"] != "worst":
                continue
            case = f"{word} {row['value']}: {row['algorithm']}"
            is_bounded = row["bound"] == ">"
            for subject, key in (("limit", "p50"), ("95 % from", "ci_low"), ("95 % to", "ci_high")):
                value = None if is_bounded and subject != "limit" else number(row[key])
                yield data_rows.row(case, subject, impairment(row), value)


def network_rows(folder):
    """How many networks an algorithm bears, by task and in all of them."""
    for name, table, keys in (
            ("plane", "qos.csv", ("delay_ms", "jitter_ms", "loss_percent")),
            ("any-network", "sessions_by_point.csv", ("point",))):
        tiers = collections.defaultdict(dict)
        for row in rows_in(folder / name / table):
            if row["task"] != "P1":
                network = tuple(row[key] for key in keys)
                tiers[row["algorithm"], row["task"]][network] = row["tier"]
        tasks = sorted({task for _, task in tiers})
        for algorithm in dict.fromkeys(algorithm for algorithm, _ in tiers):
            for tier, enough in TIERS.items():
                bears = {task: {network for network, one in tiers[algorithm, task].items()
                                if one in enough} for task in tasks}
                bears["all tasks"] = set.intersection(*bears.values())
                for subject, networks in bears.items():
                    yield data_rows.row(f"{name}: {algorithm}", subject, f"{tier} networks",
                                        len(networks))


def hand_rows(folder):
    """Up to which delay an algorithm bears every delay that was tried, by the number of hands."""
    tiers = collections.defaultdict(list)
    for row in rows_in(folder / "many/qos.csv"):
        key = f"hands: {row['algorithm']}", f"{row['peers']} hands", row["task"]
        tiers[key].append((float(row["delay_ms"]), row["tier"]))
    for (case, hands, task), by_delay in tiers.items():
        for tier, enough in TIERS.items():
            borne = list(itertools.takewhile(lambda one: one[1] in enough, sorted(by_delay)))
            yield data_rows.row(case, hands, f"{task} {tier}, ms",
                                borne[-1][0] if borne else None)


def precision_rows(folder):
    """How far the figures of each tick are from those of the shortest, by all seeds, and what fewer
    seeds are off."""
    for name in ("work-precision", "work-precision-limits"):
        table = rows_in(folder / name / "precision.csv")
        most = {}  # seeds of a figure: P1 has one
        for row in table:
            case = f"tick: {row['algorithm']}, {row['task']}, {row['figure']}"
            most[case] = max(most.get(case, 0), int(row["seeds"]))
        for row in table:
            case = f"tick: {row['algorithm']}, {row['task']}, {row['figure']}"
            if row["value"] == row["reference"] and row["seeds"] == "10":
                yield data_rows.row(case, row["value"], "error of ten seeds", number(row["error"]))
            if int(row["seeds"]) != most[case]:
                continue
            if row["value"] == row["reference"]:
                yield data_rows.row(case, row["value"], "figure", number(row["found"]))
                continue
            for metric, key in (("difference", "difference"), ("95 % from", "ci_low"),
                                ("95 % to", "ci_high")):
                if row[key]:
                    yield data_rows.row(case, row["value"], metric, number(row[key]))


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, metavar="DIR")
    folder = parser.parse_args().folder
    manifest = json.loads(text_of(folder / "plane/manifest.json"))
    tables = convention_rows, reading_rows, network_rows, hand_rows, precision_rows
    rows = [row for rows_of in tables for row in rows_of(folder)]
    data_rows.print_file(
        {"about": "A limit is that of the task with the lowest one; without an interval it is the "
                  "most that was tried.",
         **data_rows.head(manifest, "scripts/reproduce.sh --all")}, rows=rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
