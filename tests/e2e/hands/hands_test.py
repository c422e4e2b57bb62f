# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""From recordings to a page: imports motions that this test makes, of six pairs of people, plays
them beside the simulated hands, and looks at the scripts, the tables and the page.

Usage: hands_test.py FOLDER-WITH-THE-PROGRAMS
"""

import csv
import json
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile

RATE = 100
PAIRS = 6
EXPERIMENT = """
title = "recorded hands"
kind = "table1"
duration = "7s"
seeds = 1
algorithms = ["base", "dead-reckoning", "remote-proxy"]
tasks = ["T3"]
[both]
delay = "80ms"
[axis]
key = "hands"
values = ["nominal", "people"]
"""


def lab(*words, code=0):
    done = subprocess.run([PROGRAMS / "hapnet-lab", *map(str, words)], capture_output=True,
                          text=True, timeout=300, check=False)
    assert done.returncode == code, (words, done.returncode, done.stdout, done.stderr)
    return done.stdout if code == 0 else done.stderr


def place(pair, trial, second):
    """Where both hands are, mm: they meet, sway together and part."""
    near = min(second / 1.2, 1.0, (4.0 - second) / 0.8)
    near = near * near * (3 - 2 * near)
    sway = (40 + 5 * pair) * math.sin((1 + 0.2 * pair) * second + trial)
    noise = 0.3 * math.sin(2 * math.pi * 30 * second)  # above the cutoff
    return ((sway - 400 + 280 * near + noise, 20 * near, 1000 + 10 * math.sin(second)),
            (sway + 400 - 280 * near, 20 * near, 1010 + 10 * math.sin(second)))


def recording(path, pair, trial, lost=range(0)):
    """x to the right, z up: a table with semicolons and decimal commas, without times."""
    lines = ["a_x;a_y;a_z;b_x;b_y;b_z"]
    for row in range(4 * RATE + 1):
        a, b = place(pair, trial, row / RATE)
        cells = [f"{value:.3f}".replace(".", ",") for value in a + b]
        lines.append(";".join(["nan"] * 3 + cells[3:] if row in lost else cells))
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def take(path, *more, code=0):
    return lab("import", "hands", path, "--columns", "a_x,a_y,a_z,b_x,b_y,b_z", "--units", "mm",
               "--axes", "x,z,-y", "--rate", f"{RATE}Hz", "--out", FOLDER / "people", *more,
               code=code)


def rows(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def imports():
    for pair in range(1, PAIRS + 1):
        for trial in (1, 2):
            lost = range(150, 154) if (pair, trial) == (2, 1) else range(0)
            path = recording(FOLDER / f"{pair}-{trial}.csv", pair, trial, lost)
            said = take(path, "--subject", f"{pair:02}", "--trial", trial)
            assert "manifest.json" in said and f"subject {pair:02}, trial {trial}" in said, said
    refused = take(recording(FOLDER / "gap.csv", 1, 1, range(100, 140)), code=2)
    assert "line 142: the hand was not seen for 410 ms" in refused, refused
    manifest = json.loads((FOLDER / "people/manifest.json").read_text(encoding="utf-8"))
    assert len(manifest["trials"]) == 2 * PAIRS
    for trial in manifest["trials"]:
        gaps = 1 if (trial["subject"], trial["trial"]) == ("02", "1") else 0
        assert (trial["a"]["gaps"], trial["b"]["gaps"]) == (gaps, 0), trial
        assert trial["axes"] == "x,z,-y" and trial["rate_hz"] == RATE
        check_script(trial)
    again = take(FOLDER / "1-1.csv", "--subject", "01", "--trial", "1")
    assert "subject 01" in again
    same = json.loads((FOLDER / "people/manifest.json").read_text(encoding="utf-8"))
    assert same == manifest


def check_script(trial):
    """Against the motion itself: scaled, moved, without what is above the cutoff, and in time."""
    script = rows(FOLDER / "people" / trial["a"]["script"])
    assert len(script) == 4001
    xs = [1e3 * float(row["x_m"]) for row in script]
    assert max(map(abs, xs)) <= 80.0 + 1e-6
    pair, number = int(trial["subject"]), int(trial["trial"])
    scale, meeting = trial["scale"], round(1e3 * trial["meeting_s"])
    assert 0 < scale < 1 and abs(xs[meeting] + 21) < 1e-6, trial
    missed = 0.0
    for tick in range(300, 3700, 10):
        t = tick / 1000
        meant = place(pair, number, t)[0][0] - 0.3 * math.sin(2 * math.pi * 30 * t)
        origin = place(pair, number, meeting / 1000)[0][0] - 0.3 * math.sin(
            2 * math.pi * 30 * meeting / 1000)
        missed = max(missed, abs(xs[tick] + 21 - scale * (meant - origin)))
    assert missed < scale * 5.0, (trial, missed)  # the corners of the approach are rounded
    speed = max(math.dist(*(
        [1e6 * float(row[axis]) for axis in ("x_m", "y_m", "z_m")] for row in pair_of))
        for pair_of in zip(script, script[1:]))
    assert abs(speed - trial["a"]["speed_max_mm_s"]) < 1e-2 * speed + 1.0, (speed, trial)
    assert speed <= trial["speed_limit_mm_s"]


def plays():
    (FOLDER / "own.toml").write_text(EXPERIMENT, encoding="utf-8")
    out = FOLDER / "results"
    lab("run", FOLDER / "own.toml", "--out", out)
    sessions = rows(out / "sessions_by_axis.csv")
    recorded = [row for row in sessions if row["value"] == "people"]
    assert len([row for row in recorded if row["task"] == "T3"]) == 3 * 2 * PAIRS
    assert {(row["subject"], row["trial"]) for row in recorded} == {
        (f"{pair:02}", str(trial)) for pair in range(1, PAIRS + 1) for trial in (1, 2)}
    assert all(row["subject"] == "" for row in sessions if row["value"] == "nominal")
    check_between_subjects(out, recorded)
    check_rankings(rows(out / "rankings.csv"))
    page = pathlib.Path(lab("report", out).strip())
    text = page.read_text(encoding="utf-8")
    for words in ("12 trials of 6 subjects", "none of them reacted to its forces",
                  "Whether recorded people rank the algorithms alike"):
        assert words in text, words
    again = lab("run", FOLDER / "own.toml", "--out", out)
    assert " 0 sessions played" in again, again
    # A changed script is another session.
    script = FOLDER / "people/01-1-a.csv"
    script.write_text(script.read_text(encoding="utf-8") + "4.001,-0.08,0,0\n", encoding="utf-8")
    changed = lab("run", FOLDER / "own.toml", "--out", out)
    assert " 0 sessions played" not in changed, changed


def check_between_subjects(out, recorded):
    task = next(row for row in rows(out / "tasks_by_axis.csv")
                if row["value"] == "people" and row["algorithm"] == "base")
    assert (task["subjects"], task["trials"], task["seeds"]) == ("6", "12", "12"), task
    means = {}
    for row in recorded:
        if (row["algorithm"], row["task"]) == ("base", "T3"):
            means.setdefault(row["subject"], []).append(float(row["mean_mm"]))
    subjects = [sum(values) / len(values) for values in means.values()]
    mean = sum(subjects) / len(subjects)
    assert abs(float(task["mean_mm"]) - mean) < 2e-3, (task, mean)
    low, high = float(task["ci_low_mm"]), float(task["ci_high_mm"])
    assert min(subjects) - 1e-3 <= low <= mean <= high <= max(subjects) + 1e-3, (task, subjects)
    paired = [row for row in rows(out / "paired_by_axis.csv")
              if row["value"] == "people" and row["measure"] == "mean_mm" and row["task"] == "T3"]
    assert paired and all(row["seeds"] == "6" for row in paired), paired


def check_rankings(table):
    for value in ("nominal", "people"):
        here = [row for row in table if row["value"] == value and row["task"] == "T3"]
        for row in here:  # where two are equal, both have the better place
            nearer = sum(float(other["mean_mm"]) < float(row["mean_mm"]) for other in here)
            assert int(row["rank"]) == 1 + nearer, here
        by_rank = sorted(here, key=lambda row: int(row["rank"]))
        means = [float(row["mean_mm"]) for row in by_rank]
        assert means == sorted(means), here
    means = {value: [float(row["mean_mm"]) for row in table
                     if row["value"] == value and row["task"] == "T3"]
             for value in ("nominal", "people")}
    for value, of_value in means.items():
        for row in table:
            if row["value"] == value and row["task"] == "T3":
                meant = tau_b(of_value, means["nominal"])
                assert abs(float(row["kendall_tau"]) - meant) < 1e-3, (means, row)


def tau_b(a, b):
    signs = [[(x > y) - (x < y) for i, x in enumerate(of) for y in of[i + 1:]] for of in (a, b)]
    told = math.sqrt(math.prod(sum(map(abs, of)) for of in signs))
    return sum(x * y for x, y in zip(*signs)) / told


def one_line():
    """Sessions as long as their own recordings, and what cannot be played."""
    (FOLDER / "plane.toml").write_text(
        'title = "p"\nkind = "plane"\nduration = "script"\nseeds = 1\nalgorithms = ["base"]\n'
        'tasks = ["T3"]\nhands = { people = "people/", preset = "firm" }\n'
        '[plane]\ndelay = ["0ms", "80ms"]\njitter = "0ms"\nloss = "0%"\n', encoding="utf-8")
    lab("run", FOLDER / "plane.toml", "--out", FOLDER / "plane")
    lengths = {row["duration_s"] for row in rows(FOLDER / "plane/sessions.csv")}
    assert lengths == {"7", "7.001"}, lengths
    cells = rows(FOLDER / "plane/qos.csv")
    assert len(cells) == 2 and all(row["subjects"] == "6" for row in cells), cells
    manifest = json.loads((FOLDER / "plane/manifest.json").read_text(encoding="utf-8"))
    assert 'duration = "script"' in manifest["configuration"]
    assert manifest["people"]["trials"] == 12
    plan = FOLDER / "plan"
    lab("plan", FOLDER / "plane.toml", "--out", plan)
    lab("run", plan, "--shard", "0/2")
    lab("run", plan, "--shard", "1/2")
    lab("merge", plan)
    for name in ("qos.csv", "sessions.csv"):
        assert (plan / name).read_bytes() == (FOLDER / "plane" / name).read_bytes(), name
    for setting, words in (("hands=nobody", "neither an operator"),
                           ("hands=no/where", "no/where/manifest.json"),
                           ('script=["a.csv", ""]', "a.csv")):
        refused = lab("run", FOLDER / "plane.toml", "--set", setting, "--out", FOLDER / "x", code=2)
        assert words in refused, refused


def fits():
    """Simulated hands that move as the recorded ones, judged by trials that no fit saw."""
    out = FOLDER / "fitted"
    said = lab("fit", "hands", FOLDER / "people", "--trials", 4, "--out", out)
    assert f"fitted to {PAIRS} trials of {PAIRS} subjects; judged by {PAIRS} others" in said, said
    fit = json.loads((out / "fit.json").read_text(encoding="utf-8"))
    trials = {name: json.loads((out / name / "manifest.json").read_text(encoding="utf-8"))["trials"]
              for name in ("seen", "unseen", "simulated")}
    assert [trial["trial"] for trial in trials["unseen"]] == ["2"] * PAIRS
    assert len(trials["simulated"]) == 4 * PAIRS
    assert all(trial["a"]["source"] == "fit.json" for trial in trials["simulated"])
    for name, of_name in trials.items():
        check_figures(fit, name, [own_figures(out / name, trial) for trial in of_name])
    # The printed table marks what the model misses.
    for row in fit["figures"]:
        line, = (line for line in said.splitlines()
                 if line.startswith(f"{row['motion']} {row['figure']} "))
        is_inside = row["unseen_min"] <= row["simulated"] <= row["unseen_max"]
        assert line.endswith("  outside") != is_inside, line
    for trial in trials["simulated"]:
        assert 0 < trial["scale"] <= 1 and trial["press_mm"] == 4, trial
    lab("run", out / "judge.toml", "--out", FOLDER / "judge")
    table = rows(FOLDER / "judge/rankings.csv")
    assert {row["value"] for row in table} == {"unseen/", "seen/", "simulated/"}, table
    again = lab("fit", "hands", FOLDER / "people", "--trials", 4, "--out", FOLDER / "again")
    assert again.replace("again", "fitted") == said
    assert (FOLDER / "again/fit.json").read_bytes() == (out / "fit.json").read_bytes()
    refused = lab("fit", "hands", FOLDER / "people", "--unseen", "77", "--out", out, code=2)
    assert "the folder has no such subject: its subjects are 01, 02" in refused, refused
    refused = lab("fit", "hands", out / "unseen", "--out", out, code=2)
    assert "would be overwritten" in refused, refused
    refused = lab("fit", "hands", FOLDER, "--out", out, code=2)
    assert "manifest.json" in refused, refused


def compares_kinds():
    """The table of what recorded hands change."""
    script = pathlib.Path(__file__).resolve().parents[3] / "scripts/recorded_hands.py"
    done = subprocess.run([script, FOLDER / "people", "--quick", "--programs", PROGRAMS, "--out",
                           FOLDER / "kinds"], capture_output=True, text=True, timeout=600,
                          check=False)
    assert done.returncode == 0, done.stderr
    table = json.loads(done.stdout)
    assert "6 seen and 6 unseen trials of 6 subjects, 24 fitted ones" in table["about"]
    kinds = ["nominal", "unseen trials", "fitted hands", "seen trials"]
    order = [row for row in table["rows"] if row["case"] == "100 ms, order"]
    assert [row["subject"] for row in order] == kinds and order[1]["value"] == 1, order
    for case in ("100 ms, base", "claim, 100 ms", "any network, remote-proxy"):
        assert {row["subject"] for row in table["rows"] if row["case"] == case} == set(kinds), case
    unseen = rows(FOLDER / "judge/rankings.csv")
    for row in table["rows"]:
        if row["subject"] != "unseen trials" or not row["metric"].startswith("mean distance"):
            continue
        algorithm = row["case"].removeprefix("100 ms, ")
        meant, = (float(one["mean_mm"]) for one in unseen
                  if (one["value"], one["task"], one["algorithm"]) == ("unseen/", "T3", algorithm))
        assert abs(row["value"] - meant) < 2e-3, (row, meant)


def compared(fit, motion, figure):
    return next(row for row in fit["figures"] if (row["motion"], row["figure"]) == (motion, figure))


def own_figures(folder, trial):
    """Speeds and spreads along x of a trial's motions, from its scripts."""
    a, b = ([tuple(1e3 * float(row[axis]) for axis in ("x_m", "y_m", "z_m"))
             for row in rows(folder / trial[side]["script"])][::20] for side in ("a", "b"))
    motions = {"middle": [[(x + y) / 2 for x, y in zip(*places)] for places in zip(a, b)],
               "apart": [[x - y for x, y in zip(*places)] for places in zip(a, b)]}
    figures = {}
    for name, places in motions.items():
        speeds = [50 * math.dist(*pair) for pair in zip(places, places[1:])]
        figures[name, "speed_mm_s"] = math.sqrt(statistics.fmean(s * s for s in speeds))
        figures[name, "spread_x_mm"] = statistics.pstdev(place[0] for place in places)
    return figures


def check_figures(fit, kind, trials):
    for motion, figure in trials[0]:
        # Every subject has equally many trials.
        meant = statistics.fmean(trial[motion, figure] for trial in trials)
        said = compared(fit, motion, figure)[kind]
        assert abs(said - meant) <= 1e-3 * meant + 1e-3, (kind, motion, figure, said, meant)


PROGRAMS = pathlib.Path(sys.argv[1]).resolve()
with tempfile.TemporaryDirectory() as made:
    FOLDER = pathlib.Path(made)
    imports()
    fits()
    compares_kinds()
    plays()
    one_line()
