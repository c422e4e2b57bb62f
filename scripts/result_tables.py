#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Tables of measured figures in pages, generated from data files.

    scripts/result_tables.py PAGE...            rewrites the tables in these pages
    scripts/result_tables.py --check PAGE...    changes nothing; exits 1 where a page differs
    scripts/result_tables.py --print FILE...    prints all rows of these data files as tables

A page holds its tables between two comments:

    <!-- data: emulator.json -->
    <!-- end data -->

The first comment names a file in the folder `data` beside the page. More may follow the name:

    <!-- data: scene.json baselines -->          compares each subject with its baselines
    <!-- data: emulator.json joined -->          has one line for all metrics of a case
    <!-- data: scene.json cases: ^stack -->      takes the rows whose "case, metric" the
                                                 regular expression finds; the last word

Without `baselines` a table has a column for each subject. A data file is a JSON object with the
keys commit, date, machine, command and rows, null where unknown, and "about" for a remark. Its rows
are those of `scripts/bench.sh --json`. Exits 2 for a usage error, a missing file or a wrong row.
"""
import json
import pathlib
import re
import sys

KEYS = ("commit", "date", "machine", "command", "rows")
ROW_KEYS = ("case", "subject", "baseline", "metric", "value", "baseline_value", "ratio", "target",
            "direction", "met")
BLOCK = re.compile(r"<!-- data: (?P<file>\S+)(?P<words>[^\n]*?) -->\n(?P<table>.*?)"
                   r"<!-- end data -->", re.DOTALL)
SUFFIX = "_ratio"


class Refused(Exception):
    """A page or data file that cannot be used, with place, reason and cure."""


def is_met(row):
    """Whether a row reaches its target, by the rule of tests/bench/common/rows.cpp."""
    judged = row["value"]
    if row["metric"].endswith(SUFFIX):
        if row["value"] == 0:
            return row["direction"] == "min"
        judged = row["ratio"]
    if judged is None:
        return False
    return judged >= row["target"] if row["direction"] == "min" else judged <= row["target"]


def check_row(place, row):
    if tuple(row) != ROW_KEYS:
        raise Refused(f"{place}: its keys are {', '.join(row)}: write {', '.join(ROW_KEYS)}")
    if row["direction"] not in ("min", "max"):
        raise Refused(f"{place}: unknown direction '{row['direction']}': use min or max")
    met = None if row["target"] is None else is_met(row)
    if row["met"] != met:
        raise Refused(f"{place}: 'met' is {row['met']}, but its figures say {met}: correct one")
    if row["ratio"] is not None:
        ratio = row["baseline_value"] / row["value"]
        if abs(row["ratio"] - ratio) > 0.02 * ratio:  # figures have three digits
            raise Refused(f"{place}: 'ratio' is {row['ratio']}, but its figures say {ratio:.3g}")


def read_data(path):
    """A data file, checked."""
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise Refused(f"{path}: cannot be read: {error}") from error
    missing = [key for key in KEYS if key not in data]
    if missing:
        raise Refused(f"{path}: lacks {', '.join(missing)}: add them, null where unknown")
    for number, row in enumerate(data["rows"], 1):
        check_row(f"{path}: row {number}", row)
    return data


def number(value):
    if value is None:
        return "–"
    if abs(value) >= 1000 and abs(value) < 1e7:
        return f"{value:.0f}"
    return f"{value:.4g}"


def ratio_of(row):
    """The ratio of a row in parentheses, with three digits; empty where it has none."""
    ratio = row["ratio"]
    if ratio is None:
        return ""
    return f" ({ratio:.0f}x)" if 1000 <= ratio < 1e5 else f" ({ratio:.3g}x)"


def is_comparison(row):
    return row["baseline"] is not None and row["metric"].endswith(SUFFIX)


def metric_of(row):
    return row["metric"].removesuffix(SUFFIX) if is_comparison(row) else row["metric"]


def lines_of(rows):
    """The rows of each case and metric, in the order of their first rows."""
    lines = {}
    for row in rows:
        lines.setdefault((row["case"], metric_of(row)), []).append(row)
    return lines


def unique(values):
    return list(dict.fromkeys(values))


def joined(cells):
    return " / ".join(cells)


def target_of(rows):
    """The targets of a line, and whether they are met; baselines with one target share it."""
    rows = [row for row in rows if row["target"] is not None]
    has_names = len(unique(row["subject"] for row in rows)) > 1
    parts = {}
    for row in rows:
        sign = "≥" if row["direction"] == "min" else "≤"
        name = f"{row['subject']} " if has_names else ""
        unit = "x" if is_comparison(row) else ""
        parts.setdefault(f"{name}{sign} {number(row['target'])}{unit}", []).append(row)
    texts = []
    for text, group in parts.items():
        missed = [row for row in group if not row["met"]]
        against = ", ".join(row["baseline"] for row in missed if is_comparison(row))
        verdict = "met" if not missed else "**missed**" + (f" against {against}" if against else "")
        texts.append(f"{text} {verdict}")
    return "; ".join(texts)


def markdown(names, body):
    """A table; columns of figures are aligned to the right, an empty last column is left out."""
    if not any(cells[-1] for cells in body):
        names, body = names[:-1], [cells[:-1] for cells in body]
    rule = [" --- " if name in ("case", "metric", "subject", "target") else " ---: "
            for name in names]
    rows = [" " + " | ".join(cells) + " " for cells in [names, *body]]
    return "".join(f"|{row}|\n" for row in [rows[0], "|".join(rule), *rows[1:]])


def related_subjects(lines):
    """The subjects in groups: two are in one group where a line has figures of both."""
    groups = []
    for line in lines.values():
        group = unique(row["subject"] for row in line)
        for other in [one for one in groups if set(one) & set(group)]:
            groups.remove(other)
            group = unique(other + group)
        groups.append(group)
    return groups


def subject_table(lines, subjects):
    """A table with a column for each subject, or with one column that names it where no line has
    figures of two."""
    body = []
    has_one_each = len(subjects) > 1 and all(
        len(unique(row["subject"] for row in line)) == 1 for line in lines.values())
    for (case, metric), line in lines.items():
        values = {row["subject"]: number(row["value"]) for row in line if not is_comparison(row)}
        cells = list(*values.items()) if has_one_each else [values.get(one, "–")
                                                            for one in subjects]
        body.append([case, metric, *cells, target_of(line)])
    columns = ["subject", "value"] if has_one_each else subjects
    return markdown(["case", "metric", *columns, "target"], body)


def by_subject(rows, is_joined=False):
    """Tables with a column for each subject; subjects that share no line have tables of their own,
    except that all those which are alone share one. Joined, a case has one line."""
    lines = lines_of(rows)
    groups = related_subjects(lines)
    alone = [group[0] for group in groups if len(group) == 1]
    tables = []
    for subjects in [group for group in groups if len(group) > 1] + ([alone] if alone else []):
        mine = {key: line for key, line in lines.items() if line[0]["subject"] in subjects}
        tables.append(joined_table(mine, subjects) if is_joined else subject_table(mine, subjects))
    return "\n".join(tables)


def joined_table(lines, subjects):
    """A table with a line for each case, whose cells have the figures of all its metrics."""
    body = []
    for case in unique(case for case, _ in lines):
        own = {metric: line for (one, metric), line in lines.items() if one == case}
        cells = []
        for subject in subjects:
            values = [{row["subject"]: number(row["value"]) for row in line}
                      for line in own.values()]
            cells.append(joined(one.get(subject, "–") for one in values))
        targets = [target_of(line) for line in own.values()]
        body.append([case, joined(own), *cells, "; ".join(filter(None, targets))])
    return markdown(["case", "metric", *subjects, "target"], body)


def by_baseline(rows):
    """A table with a column for each baseline and its ratio to the subject."""
    body = []
    baselines = unique(row["baseline"] for row in rows if row["baseline_value"] is not None)
    for (case, metric), line in lines_of(rows).items():
        for subject in unique(row["subject"] for row in line if row["baseline_value"] is not None):
            own = [row for row in line if row["subject"] == subject]
            cells = {row["baseline"]: number(row["baseline_value"]) + ratio_of(row) for row in own
                     if row["baseline_value"] is not None}
            body.append([case, metric, subject, number(own[0]["value"]),
                         *(cells.get(baseline, "–") for baseline in baselines), target_of(own)])
    subjects = unique(cells[2] for cells in body)
    if len(subjects) == 1:
        names = ["case", "metric", subjects[0], *baselines, "target"]
        return markdown(names, [cells[:2] + cells[3:] for cells in body])
    return markdown(["case", "metric", "subject", "value", *baselines, "target"], body)


def source_of(name, data):
    """The origin of a file's figures, as a line of a page."""
    commit = None if data["commit"] is None else f"commit {data['commit']}"
    command = None if data["command"] is None else f"`{data['command']}`"
    known = [text for text in (data["date"], commit, data["machine"], command) if text is not None]
    return f"\n[{name}](data/{name}): {'; '.join(known) or 'date and machine unknown'}.\n"


def table_of(place, data, words):
    words, _, pattern = words.partition("cases:")
    words = words.split()
    if words not in ([], ["baselines"], ["joined"]):
        raise Refused(f"{place}: unknown '{' '.join(words)}': use baselines, joined or cases:")
    try:
        found = re.compile(pattern.strip())
    except re.error as error:
        raise Refused(f"{place}: '{pattern.strip()}' is no regular expression: {error}") from error
    rows = [row for row in data["rows"] if found.search(f"{row['case']}, {metric_of(row)}")]
    if not rows:
        raise Refused(f"{place}: no row matches '{pattern.strip()}': correct the expression")
    return by_baseline(rows) if words == ["baselines"] else by_subject(rows, words == ["joined"])


def generated(page, text):
    """The text of a page with its tables as the data files have them. The first table of each file
    is followed by its source."""
    if text.count("<!-- data:") != len(BLOCK.findall(text)):
        raise Refused(f"{page}: a table has no end: write <!-- end data --> below each")
    read = {}

    def block(match):
        file = match["file"]
        source = ""
        if file not in read:
            read[file] = read_data(page.parent / "data" / file)
            source = source_of(file, read[file])
        table = table_of(f"{page}: {file}", read[file], match["words"])
        head = match[0].split("\n", 1)[0]
        return f"{head}\n{table}{source}<!-- end data -->"

    return BLOCK.sub(block, text)


def handle(page, is_check):
    """True if the page agreed with its data."""
    text = page.read_text(encoding="utf-8")
    new = generated(page, text)
    if new == text:
        return True
    if is_check:
        print(f"{page}: differs from its data: run scripts/result_tables.py {page}",
              file=sys.stderr)
        return False
    page.write_text(new, encoding="utf-8")
    return True


def main(arguments):
    options = [word for word in arguments if word.startswith("--")]
    files = [pathlib.Path(word) for word in arguments if not word.startswith("--")]
    if options == ["--help"]:
        print(__doc__.strip())
        return 0
    if options not in ([], ["--check"], ["--print"]) or not files:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    try:
        if options == ["--print"]:
            for path in files:
                data = read_data(path)
                print(by_subject(data["rows"]) + source_of(path.name, data))
            return 0
        return 0 if all([handle(page, bool(options)) for page in files]) else 1
    except (Refused, OSError) as error:
        print(f"result_tables: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
