# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Turns what a program printed into text that is the same in every run.

An output of virtual time is kept as it is (exact), without the host, the build and the wall time.
An output of real time is reduced to its shape: keys, order, kinds, units and alignment.
"""

import csv
import hashlib
import io
import json
import re
from html.parser import HTMLParser

LINES_MAX = 60  # an exact output of more lines, or of a longer line, is kept as head and hash
LINE_MAX = 1000
HEAD_LINES = 6
LINE_HEAD = 160
TEXT_MAX = 100  # a longer text within JSON is kept as a head

# Parts that name the build, the host or the wall time. The pattern keeps the text before the value.
MASKS = [(re.compile(pattern), replacement) for pattern, replacement in (
    (r"\d+\.\d+\.\d+ \(commit [^)]*\)( [0-9a-f]{16})?", "VERSION (commit COMMIT, COMPILER)"),
    (r'("key":"[^"]* )[0-9a-f]{16}"', r'\1BUILD"'),  # of a session: the build is part of the hash
    (r'"sum":"[0-9a-f]+"', '"sum":"OF THE LINE"'),
    (r'("(?:version|commit|compiler|start|boot_id)": ?)"[^"]*"', r'\1"MASKED"'),
    (r'("(?:wall_time_s|processor_time_s|speed_ratio|started_unix_s)": ?)[\d.e+-]+', r"\g<1>0.0"),
    (r'(?<="host":) ?\{[^}]*\}', lambda found: re.sub(
        r'(: ?)("?)(?![ {])[^",\n{}]+',
        lambda value: f'{value[1]}"MASKED' if value[2] else f"{value[1]}0", found[0])),
    # In the tables of a page.
    (r'(\["(?:version|commit|compiler|host|start|(?:wall|processor) time, s|speed ratio)",'
     r'\{"text":)"[^"]*"', r'\1"MASKED"'),
    (r'("name":"(?:version|commit)","cells":)\["[^"]*","[^"]*"\]', r'\1["MASKED","MASKED"]'),
    (r'(\["reported/[^"]*",\{"text":"[^"]*","style":"words"\},)"[\d.]+",("[\d.]+"),"[\d.]+"',
     r'\1"MASKED",\2,"MASKED"'),
    (r"(?m)^\d+/\d+ sessions \(.*\n", ""),  # progress
    (r"(?m)^hapnet-\w+: (SCHED_FIFO|locked memory).*\n", ""),  # of the machine, not of the run
)]


def masked(text):
    """The text without what differs between builds, hosts and runs."""
    for pattern, replacement in MASKS:
        text = pattern.sub(replacement, text)
    return text


def exact(text, form="text", seen=None):
    """An output of virtual time: whole, or where it is long its head, its shape and a hash. seen:
    the shapes that the reader knows already, as some outputs have the same one."""
    text = masked(text)
    lines = text.splitlines()
    if form == "jsonl":  # after the header, in the order in which sessions were played
        lines = [*lines[:1], *sorted(lines[1:])]
        text = "".join(f"{line}\n" for line in lines)
    elif len(lines) <= LINES_MAX and all(len(line) <= LINE_MAX for line in lines):
        return text
    digest = hashlib.sha256(text.encode()).hexdigest()[:16]
    last = f"... {len(lines)} lines, {len(text)} characters, sha256 {digest}\n"
    if form == "text":
        return "".join(f"{line[:LINE_HEAD]}\n" for line in lines[:HEAD_LINES]) + last
    shape = shape_of_json(*(lines if form == "jsonl" else [text]), texts=False)
    seen = {} if seen is None else seen
    if shape in seen:
        return f"as shape {seen[shape]} above\n{last}"
    seen[shape] = len(seen) + 1
    return f"shape {seen[shape]}:\n{shape}{last}"


# --- The shape of JSON


class Node:
    """What is known of all values at one place of the documents."""

    def __init__(self):
        self.kinds, self.texts, self.lengths, self.numbers = set(), set(), set(), set()
        self.count = self.objects = 0
        self.children = {}  # the paths below, in their order

    def add(self, value):
        self.count += 1
        if isinstance(value, dict):
            self.kinds.add("object")
            self.objects += 1
        elif isinstance(value, list):
            self.kinds.add("list")
            self.lengths.add(len(value))
        elif isinstance(value, Number):
            self.kinds.add("integer" if value.isdigit() else "number")
            self.numbers.add(value)
        elif isinstance(value, str):
            self.kinds.add("text")
            self.texts.add(masked_numbers(value)[:TEXT_MAX])
        else:
            self.kinds.add("null" if value is None else "boolean")

    def words(self, texts):
        kinds = self.kinds - ({"integer"} if "number" in self.kinds else set())
        ordered = sorted(kinds, key=lambda kind: (kind != "null", kind))
        return " or ".join(self.of_kind(kind, texts) for kind in ordered)

    def of_kind(self, kind, texts):
        if kind == "text" and texts and len(self.texts) == 1:
            return json.dumps(next(iter(self.texts)), ensure_ascii=False)
        if kind == "list" and len(self.lengths) == 1 and max(self.lengths) <= 4:
            return f"list of {max(self.lengths)}"
        return kind


class Number(str):
    """A number as it is written."""

    def isdigit(self):
        return self.lstrip("-").isdecimal()


def shape_of_json(*documents, loose=(), units=False, texts=True):
    """A line for each key, in the order of the first document that has it: its path, and the kinds
    of its values. loose: (pattern of a path, the words of its kind), where these are up to chance;
    "left out" where it is whether it is there at all.
    units: also the most decimals of the values of each unit; for shortest numbers of real time.
    texts: a text that is the same everywhere stands for itself."""
    nodes = {}

    def visit(path, value):
        nodes.setdefault(path, Node()).add(value)
        items = value.items() if isinstance(value, dict) else []
        if isinstance(value, list):
            items = [("[]", one) for one in value]
        for key, one in items:
            below = f"{path}[]" if key == "[]" else f"{path}.{key}".lstrip(".")
            if kind_of(below, loose) != "left out":
                nodes[path].children.setdefault(below)
                visit(below, one)

    for document in documents:
        visit("", json.loads(document, parse_int=Number, parse_float=Number))
    lines = []

    def describe(path):
        node = nodes[path]
        for below in node.children:
            is_optional = not below.endswith("[]") and nodes[below].count < node.objects
            words = kind_of(below, loose) or nodes[below].words(texts)
            if words != "object":
                lines.append(f"{below}{'?' if is_optional else ''}: {words}")
            describe(below)

    describe("")
    return "\n".join(lines + (units_of(nodes) if units else [])) + "\n"


def kind_of(path, loose):
    """The words of the first loose pattern that fits a path, or nothing."""
    return next((words for pattern, words in loose if re.search(pattern, path)), "")


def units_of(nodes):
    """The most decimals of the numbers of each unit, to nine, without what doubles add."""
    of_units = {}
    for path, node in nodes.items():
        found = re.findall(r"_(us|ms|s|mm|n|j|hz)(?=[.\[]|$)", path)
        if found and "number" in node.kinds:
            of_units.setdefault(found[-1], []).extend(node.numbers)
    return [f"most decimals of {unit}: "
            + str(max(len(f"{float(number):.9f}".rstrip("0").partition(".")[2])
                      for number in numbers))
            for unit, numbers in sorted(of_units.items()) if len(numbers) >= 6]


# --- The shape of text

A_NUMBER = re.compile(r"( *)(?<![\w.])([+-]?)(\d+)((?:\.\d+)?)(e[+-]?\d+)?"
                      r"(?!\w*[A-Za-z_])(?!\.\d)(?=( *))")


def masked_numbers(text, general=False):
    """The text with # for the whole part of each number and a # for each decimal. Where two or more
    spaces are before or behind it the number stands in a column, whose place stays. general: of
    numbers whose decimals vary with their values."""
    def mask(found):
        before, sign, whole, decimals, power, behind = found.groups(default="")
        short = "#" + re.sub(r"\d", "#", decimals) + ("e#" if power else "")
        short = "#" if general else short
        missing = len(sign + whole + decimals + power) - len(short)
        if len(before) >= 2:
            before += " " * missing
        elif len(behind) >= 2:
            short += " " * missing
        return before + short
    return A_NUMBER.sub(mask, text)


def shape_of_csv(text):
    """The header, and below each column the formats of its cells."""
    rows = list(csv.reader(io.StringIO(text)))
    lines = [",".join(rows[0])]
    for number, name in enumerate(rows[0]):
        formats = sorted({masked_numbers(row[number]) for row in rows[1:]})
        formats = [one or "empty" for one in formats]
        lines.append(f"{name}: {' or '.join(formats) if len(formats) <= 8 else 'text'}")
    return "\n".join(lines) + "\n"


def shape_of_metrics(text):
    """Prometheus text: the samples of a metric in the order of their labels, which says nothing."""
    lines, samples = [], []
    for line in [*text.splitlines(), "#"]:
        if line.startswith("#"):
            lines += sorted(samples)
            lines, samples = lines + [line], []
        else:
            name, value = line.rsplit(" ", 1)
            kind = "integer" if Number(value).isdigit() else "number"
            samples.append(f"{name} {kind}")
    return "\n".join(lines[:-1]) + "\n"


# --- The content of a page


class Page(HTMLParser):
    """Headings, paragraphs and rows of tables as lines, without drawings; and embedded data."""

    BLOCKS = {"h1", "h2", "h3", "p", "tr", "caption", "li", "figcaption", "summary", "pre", "div"}

    def __init__(self):
        super().__init__()
        self.lines, self.line, self.data = [], "", {}
        self.hidden, self.script = 0, None

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        if tag in ("svg", "style"):
            self.hidden += 1
        elif tag == "script":
            self.script = attributes.get("id", "")
            self.data[self.script] = ""
        elif tag in self.BLOCKS:
            self.end_line()
        elif tag in ("td", "th") and self.line:
            self.line += " | "

    def handle_endtag(self, tag):
        if tag in ("svg", "style"):
            self.hidden -= 1
        elif tag == "script":
            self.script = None
        elif tag in self.BLOCKS:
            self.end_line()

    def handle_data(self, data):
        if self.script is not None:
            self.data[self.script] += data
        elif not self.hidden:
            self.line += re.sub(r"\s+", " ", data)

    def end_line(self):
        if self.line.strip(" |"):
            self.lines.append(self.line.strip())
        self.line = ""


def page_of(html):
    """The lines of a page, and its embedded data by their names."""
    page = Page()
    page.feed(html)
    page.end_line()
    data = {name: text for name, text in page.data.items() if name not in ("", "modules")}
    return "\n".join(page.lines) + "\n", data
