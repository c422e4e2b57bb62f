# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Sessions that are judged by a metric of one's own. HAPNET_BIN has the programs."""

import csv
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from hapnet import Lab, judge, read_csv
from hapnet.student import mean_of
from hapnet.threshold import threshold_of
from hapnet.verdict import (
    GOOD, NOT_GOOD, UNDECIDED, CannotJudge, Group, Limits, judged, share_interval, thresholds,
)

EXPERIMENT = """title = "judged"
kind = "table1"
seeds = 7
duration = "1s"
algorithms = ["base", "sep"]
tasks = ["T3"]

[both]
delay = "40ms"
"""
GROUPS = [("", "", name, task) for name in ("base", "sep") for task in ("P1", "T3")]

LIMITS = """title = "limits"
kind = "limits"
seeds = 8
duration = "3s"
algorithms = ["base", "dead-reckoning"]
tasks = ["T1"]

[limit.delay]
from = "80ms"
to = "240ms"
step = "40ms"
resolution = "5ms"

[limit.random-loss]
from = "60%"
to = "99%"
step = "10%"
resolution = "1%"
"""

METRICS = '''
calls = []


def farthest(a, b):
    """Largest distance in x of the two copies at equal times while both run, in mm: the max of D
    in docs/design/metrics.md. Both records of the lab have one clock."""
    calls.append(a.config["seed"])
    ours, theirs = running(a), running(b)
    return 1e3 * max(abs(ours[at] - theirs[at]) for at in ours if at in theirs)


def running(record):
    columns = map(record.ticks.column, ("due", "late", "cube", "phase"))
    return {due + late: cube[0] for due, late, cube, phase in zip(*columns) if phase == 2}


def apart(a, b):
    """Mean distance in x of the two copies, in mm."""
    ours, theirs = running(a), running(b)
    both = ours.keys() & theirs.keys()
    return 1e3 * sum(abs(ours[at] - theirs[at]) for at in both) / len(both)


def rising(a, b):
    """Delay in ms, and 3 more for each seed after the first."""
    text = a.config["network_toml"]
    delay = next((level for level in (20, 30, 40) if f"{level}ms" in text), 0)
    return delay + 3.0 * (a.config["seed"] - 1001)


def delay(a, b):
    """Ticks, as a value that is quick to know."""
    calls.append(0)
    return float("0ms" in a.config["network_toml"])


def raises(a, b):
    if a.config["task"] == "T3":
        raise KeyError("drift")
    return 1.0


def later(a, b):
    calls.append(a.config["seed"])
    return 1 / (a.config["seed"] - 1002)


def nothing(a, b):
    return None


def nan(a, b):
    return float("nan")


def word(a, b):
    return "1.0"
'''


def lines_in(path):
    """The number of whole lines of a file; 0 if there is no such file."""
    try:
        with open(path, "rb") as file:
            return file.read().count(b"\n")
    except FileNotFoundError:
        return 0


class AMetric(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory(prefix="hapnet-judge-")
        self.folder = self.temporary.name
        self.experiment = self.path("my.toml")
        self.write("my.toml", EXPERIMENT)
        self.write("mine.py", METRICS)
        sys.path.insert(0, self.folder)
        self.mine = __import__("mine")

    def tearDown(self):
        sys.path.remove(self.folder)
        del sys.modules["mine"]
        self.temporary.cleanup()

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def judge(self, metric, **more):
        return judge.run(self.experiment, getattr(self.mine, metric),
                         **{"out": self.path("out"), "jobs": 1, "seeds": 2, **more})

    def rows(self, name):
        with open(self.path("out", name), encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def command(self, *words):
        return [sys.executable, "-m", "hapnet.judge", *words]

    def program(self, *words, code):
        done = subprocess.run(
            self.command(*words), stdin=subprocess.DEVNULL, capture_output=True,
            text=True, timeout=100, check=False)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def test_measures_what_the_lab_measures(self):
        verdicts = self.judge("farthest", at_most=10.0, unit="mm")
        self.assertEqual([one.group for one in verdicts], GROUPS)
        lab = {}
        for seed in (1001, 1002):
            done = Lab().run(self.experiment, self.path(f"lab-{seed}"), {"first_seed": str(seed)},
                             seeds=1, jobs=1)
            for row in done.rows("sessions.csv"):
                lab[row["algorithm"], row["task"], seed] = row["max_mm"]
        for one in verdicts:
            self.assertEqual(list(one.values), [1001, 1002])
            for seed, value in one.values.items():  # the table has three decimals
                expected = lab[one.group.algorithm, one.group.task, seed]
                self.assertAlmostEqual(value, expected, delta=0.000501)
            self.assertEqual(one.mean, mean_of(list(one.values.values()))[0])
            self.assertEqual(one.verdict, GOOD)
        self.assertNotEqual(*verdicts[1].values.values())  # seeds of T3 differ

        table = self.rows("farthest.csv")
        self.assertEqual(list(table[0]), ["parameter", "value", "algorithm", "task", "seeds",
                                          "mean", "ci_low", "ci_high", "unit", "limit", "verdict",
                                          "usable_seeds", "usable_ci_low", "usable_ci_high"])
        self.assertEqual([(row["seeds"], row["unit"], row["limit"], row["verdict"],
                           row["usable_seeds"], row["usable_ci_high"])
                          for row in table], [("2", "mm", "<= 10.0", "good", "2", "1.0")] * 4)
        self.assertEqual([float(row["mean"]) for row in table], [one.mean for one in verdicts])
        self.assertEqual(sorted(os.listdir(self.path("out"))),
                         ["farthest-sessions.csv", "farthest.csv"])  # no records, nothing half

    def test_has_the_mean_distance_of_the_lab(self):
        verdicts = self.judge("apart", seeds=1)
        lab = Lab().run(self.experiment, self.path("lab"), seeds=1, jobs=1).rows("sessions.csv")
        self.assertEqual(len(lab), 4)
        for one, row in zip(verdicts, lab):
            self.assertEqual(one.group[2:], (row["algorithm"], row["task"]))
            self.assertAlmostEqual(one.mean / row["mean_mm"], 1.0, delta=0.01)

    def test_says_how_many_sessions_are_usable_and_where_half_of_them_fail(self):
        self.write("my.toml", EXPERIMENT.replace('["base", "sep"]', '"base"') +
                   '[axis]\nkey = "both.delay"\nvalues = ["40ms", "0ms", "20ms", "30ms"]\n')
        verdicts = self.judge("rising", seeds=5, at_most=33.0, unit="ms")
        usable = {"40ms": 0, "0ms": 5, "20ms": 5, "30ms": 2}
        self.assertEqual([(one.group.value, one.usable_seeds) for one in verdicts],
                         [(value, count) for value, count in usable.items() for _ in range(2)])
        table = self.rows("rising.csv")
        self.assertEqual([int(row["usable_seeds"]) for row in table[::2]], list(usable.values()))
        self.assertAlmostEqual(float(table[6]["usable_ci_low"]), 0.1176, delta=1e-4)

        found = self.rows("rising-p50.csv")
        self.assertEqual([(row["parameter"], row["algorithm"], row["task"], row["seeds"],
                           row["bound"], row["unit"]) for row in found],
                         [("both.delay", "base", task, "5", "=", "ms") for task in ("P1", "T3")])
        for row in found:  # two of five pass at 30 ms, and all at 20 ms
            self.assertTrue(28.0 < float(row["p50"]) < 30.0, row)
            self.assertTrue(20.0 <= float(row["ci_low"]) < 28.0, row)
            self.assertTrue(30.0 < float(row["ci_high"]) <= 40.0, row)
        self.assertEqual(thresholds(verdicts)[Group("both.delay", "", "base", "T3")].p50,
                         float(found[1]["p50"]))

        self.judge("rising", seeds=5)  # without a limit no session is unusable
        self.assertEqual({row["usable_seeds"] for row in self.rows("rising.csv")}, {""})
        self.assertNotIn("rising-p50.csv", os.listdir(self.path("out")))

    def test_goes_on_after_an_interrupt(self):
        metric = self.path("mine.py") + ":rising"
        words = [self.experiment, "--metric", metric, "--seeds", "1", "--jobs", "1",
                 "--set", "duration=10s", "--set", "axis.key=both.jitter",
                 "--set", "axis.from=0ms", "--set", "axis.to=12ms", "--set", "axis.step=1ms",
                 "--out", self.path("out")]
        sessions = self.path("out", "rising-playing", "sessions.jsonl")
        with subprocess.Popen(self.command(*words), stdin=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, text=True) as running:
            end = time.monotonic() + 30.0
            while lines_in(sessions) < 3 and time.monotonic() < end:
                time.sleep(0.01)
            running.send_signal(signal.SIGINT)
            said = running.stderr.read()
        self.assertEqual(running.returncode, 130, said)
        self.assertIn("interrupted; the same command goes on", said)
        played = lines_in(sessions)
        self.assertGreaterEqual(played, 3)

        again = subprocess.Popen(self.command(*words), stdin=subprocess.DEVNULL)
        try:
            manifest = self.path("out", "rising-playing", "manifest.json")
            while not os.path.exists(manifest) and time.monotonic() < end + 60.0:
                time.sleep(0.01)
            with open(manifest, encoding="utf-8") as file:
                self.assertIn(f'"reused": {played - 1}', file.read())
        finally:
            again.kill()
            again.wait()

    def test_leaves_out_what_an_interrupt_left_of_another_experiment(self):
        Lab().run(self.experiment, self.path("out", "delay-playing"), seeds=1, jobs=1)
        self.write("my.toml", EXPERIMENT.replace("judged", "judged otherwise"))
        self.assertEqual(len(self.judge("delay", seeds=1)), 4)
        self.assertNotIn("delay-playing", os.listdir(self.path("out")))

    def test_plays_only_what_is_missing(self):
        first = self.judge("farthest")
        self.assertEqual([one.verdict for one in first], [None] * 4)
        self.assertEqual(len(self.mine.calls), 8)
        again = self.judge("farthest", at_least=20.0)
        self.assertEqual(len(self.mine.calls), 8)
        self.assertEqual([one.values for one in again], [one.values for one in first])
        self.assertEqual({one.verdict for one in again}, {NOT_GOOD})

        self.judge("farthest", seeds=3)
        self.assertEqual(self.mine.calls[8:], [1003] * 4)
        fewer = self.judge("farthest", seeds=1, at_most=20.0)
        self.assertEqual(len(self.mine.calls), 12)
        self.assertEqual([(list(one.values), one.ci_low, one.verdict) for one in fewer],
                         [([1001], None, UNDECIDED)] * 4)
        self.assertEqual(len(self.rows("farthest-sessions.csv")), 12)

        # Another experiment is played.
        self.judge("farthest", seeds=1, settings={"both.delay": "0ms", "first_seed": "2001"})
        self.assertEqual(self.mine.calls[12:], [2001] * 4)
        self.assertEqual({row["seed"] for row in self.rows("farthest-sessions.csv")}, {"2001"})

    def test_measures_again_what_a_changed_function_says(self):
        self.judge("delay", seeds=1)
        self.judge("delay", seeds=1)
        self.assertEqual(len(self.mine.calls), 4)
        self.write("mine.py", METRICS.replace("return float(", "return 2 * float("))
        del sys.modules["mine"]
        os.utime(self.path("mine.py"), (1, 1))
        self.mine = __import__("mine")
        changed = self.judge("delay", seeds=1)
        self.assertEqual(len(self.mine.calls), 4)
        self.assertEqual([one.mean for one in changed], [2.0] * 4)

    def test_says_at_which_point_of_the_axes(self):
        self.write("my.toml", EXPERIMENT + '[axis]\nkey = "both.jitter"\nvalues = ["0ms", "5ms"]\n')
        self.assertEqual([one.group[:3] for one in self.judge("delay", seeds=1)],
                         [("both.jitter", value, name) for value in ("0ms", "5ms")
                          for name in ("base", "base", "sep", "sep")])
        self.write("my.toml", EXPERIMENT.replace("table1", "trajectories") + "".join(
            f'[[axis]]\nkey = "{key}"\nvalues = {values}\n' for key, values in (
                ("both.delay", '["0ms", "40ms"]'), ("hands", '["relaxed", "firm"]'))))
        verdicts = self.judge("delay", seeds=1)
        self.assertEqual([(one.group.parameter, one.group.value) for one in verdicts[::2]],
                         [("both.delay; hands", f"{delay}; {hands}")
                          for delay in ("0ms", "40ms") for hands in ("relaxed", "firm")])

    def test_names_the_session_of_which_a_metric_says_nothing(self):
        for name, words in (
                ("raises", "raises of base-T3, seed 1001: it raised KeyError: 'drift'"),
                ("nan", "nan of base-P1, seed 1001: it returned nan: return a finite number"),
                ("nothing", "nothing of base-P1, seed 1001: it returned None"),
                ("word", "word of base-P1, seed 1001: it returned '1.0'")):
            with self.assertRaises(CannotJudge) as refused:
                self.judge(name)
            self.assertIn(words, str(refused.exception))
        self.assertEqual(os.listdir(self.path("out")), [])

    def test_keeps_the_seeds_before_an_error(self):
        for played in ([1001] * 4 + [1002], [1002]):
            self.mine.calls.clear()
            with self.assertRaisesRegex(CannotJudge, "later of base-P1, seed 1002: it raised Zero"):
                self.judge("later")
            self.assertEqual(self.mine.calls, played)
        self.assertEqual([row["seed"] for row in self.rows("later-sessions.csv")], ["1001"] * 4)

    def test_refuses_what_cannot_be_judged(self):
        for words, given in (
                ("an experiment of its kind keeps no records: write kind = \"table1\"",
                 {"settings": {"kind": "claims", "algorithms": '"base"'}}),
                ("seeds 0: give a number from 1 to 1000", {"seeds": 0}),
                ("the limits at most 1.0 and at least 2.0", {"at_most": 1.0, "at_least": 2.0}),
                ("a limit is not a finite number", {"at_most": float("nan")}),
                ("the metric's name '../up' cannot name files", {"name": "../up"})):
            with self.assertRaises(CannotJudge) as refused:
                self.judge("nan", **given)
            self.assertIn(words, str(refused.exception))
        os.makedirs(self.path("out"), exist_ok=True)
        self.write("out/nan-sessions.csv", "time_s,x_m\n0,1\n")
        with self.assertRaisesRegex(CannotJudge, "nan-sessions.csv:2: it is no row of a metric"):
            self.judge("nan")

    def test_is_a_command_line_too(self):
        metric = self.path("mine.py") + ":farthest"
        words = [self.experiment, "--metric", metric, "--unit", "mm", "--seeds", "2", "--jobs", "1",
                 "--out", self.path("out")]
        done = self.program(*words, "--at-most", "10", code=0)
        self.assertEqual(done.stderr, "")  # it is no terminal
        self.assertRegex(done.stdout, 
                         r"(?m)^base-P1: 4\.171 \(4\.171 to 4\.171\) mm good; usable 2 of 2$")
        self.assertEqual(len(read_csv(self.path("out", "farthest-sessions.csv"))), 8)
        self.program(*words, "--at-most", "2", code=1)
        told = self.program(*words[:-1], self.path("new"), "--progress", code=0).stderr
        self.assertEqual(told.splitlines(), [
            *(f"session {i} of 8" for i in range(1, 9)), "tables"])
        said = self.program(self.experiment, "--metric", self.path("mine.py") + ":farther", "--out",
                            self.path("out"), code=2).stderr
        self.assertIn("has no function 'farther'", said)
        self.program("none.toml", *words[1:], code=2)
        self.program(*words, "--at-mots", "2", code=2)
        options = self.program("--help", code=0).stdout
        for option in ("--metric", "--at-most", "--at-least", "--unit", "--seeds", "--set",
                       "--jobs", "--progress", "--out", "Exit codes"):
            self.assertIn(option, options)


class AVerdict(unittest.TestCase):
    def test_is_of_the_whole_interval(self):
        for low, high, most, least, expected in (
                (1.0, 2.0, 2.0, None, GOOD), (1.0, 2.1, 2.0, None, UNDECIDED),
                (2.0, 3.0, 2.0, None, UNDECIDED), (2.1, 3.0, 2.0, None, NOT_GOOD),
                (1.0, 2.0, None, 1.0, GOOD), (0.9, 2.0, None, 1.0, UNDECIDED),
                (0.0, 1.0, None, 1.0, UNDECIDED), (0.0, 0.9, None, 1.0, NOT_GOOD),
                (1.0, 2.0, 2.0, 1.0, GOOD), (0.9, 2.1, 2.0, 1.0, UNDECIDED),
                (2.1, 3.0, 2.0, 1.0, NOT_GOOD), (2.0, 2.0, 2.0, 2.0, GOOD),
                (1.0, 2.0, None, None, None), (None, None, None, None, None),
                (None, None, 2.0, None, UNDECIDED)):
            self.assertEqual(Limits(most, least).verdict(low, high), expected, (low, high, most))

    def test_has_an_interval_of_students_distribution(self):
        self.assertEqual(mean_of([3.0]), (3.0, None, None))
        self.assertEqual(mean_of([0.1] * 3), (0.1, 0.1, 0.1))
        # The standard deviation of 1 to 10 is 3.0277, and tables give 2.2622 for 9 degrees.
        _, low, high = mean_of([float(i) for i in range(1, 11)])
        self.assertAlmostEqual(low, 5.5 - 2.2622 * 3.0277 / 10**0.5, delta=1e-3)
        self.assertAlmostEqual(high, 5.5 + 2.2622 * 3.0277 / 10**0.5, delta=1e-3)


class AThreshold(unittest.TestCase):
    def test_is_that_of_the_lab(self):
        with tempfile.TemporaryDirectory(prefix="hapnet-judge-") as folder:
            path = os.path.join(folder, "limits.toml")
            with open(path, "w", encoding="utf-8") as file:
                file.write(LIMITS)
            done = Lab().run(path, os.path.join(folder, "lab"), jobs=1)
            rows, curves = done.rows("limits.csv"), done.rows("curves.csv")
        rows = [row for row in rows if row["task"] != "worst"]
        self.assertEqual(len(rows), 4)
        for row in rows:
            failed = {}
            for one in curves:
                if one["counts"] == "true" and all(
                        one[key] == row[key] for key in ("algorithm", "impairment", "task")):
                    usable = one["tier"] in ("usable", "good")
                    failed.setdefault(one["level"], {})[one["seed"]] = not usable
            found = threshold_of(*zip(*(
                (level, tuple(failed[level][seed] for seed in sorted(failed[level])))
                for level in sorted(failed))))
            for key in ("p50", "p10", "ci_low", "ci_high"):  # the table has two decimals
                self.assertAlmostEqual(getattr(found, key), row[key], delta=0.00501, msg=row)
            self.assertEqual(found.bound, row["bound"])

    def test_may_lie_above_the_levels(self):
        found = threshold_of((0.0, 10.0, 20.0), ((False,) * 8,) * 3)
        self.assertEqual((found.p50, found.bound, found.ci_high), (20.0, ">", None))
        self.assertEqual(threshold_of((0.0, 10.0), ((False,), (True,)))[:2], (5.0, "="))

    def test_is_of_one_axis_over_an_impairment(self):
        def of(parameter, values):
            limits = Limits(at_most=1.0)
            return thresholds([
                judged(Group(parameter, value, "base", "T1"), {1: 0.0, 2: float(i)}, limits)
                for i, value in enumerate(values)])

        for parameter, values, level in (("both.delay", ("0ms", "20us", "0.04ms"), 0.04),
                                         ("up.loss", ("0%", "5%", "10%"), 10.0),
                                         ('link."1-2".jitter', ("0ms", "1ms", "2ms"), 2.0)):
            found = of(parameter, values)[Group(parameter, "", "base", "T1")]
            self.assertTrue(0.0 < found.p50 <= level, found)
        for parameter, values in (("hands.stiffness", ("1N/m", "2N/m", "3N/m")), ("", ("",)),
                                  ("both.delay", ("0ms",)), ("both.delay; hands", ("0ms; firm",)),
                                  ("both.delay", ("0ms", '{ law = "gamma" }'))):
            self.assertEqual(of(parameter, values), {})


class AShare(unittest.TestCase):
    def test_has_an_interval_that_tables_give(self):  # Brown, Cai, DasGupta 2001: 10 of 10, 0 of 10
        for count, of, low, high in ((0, 10, 0.0, 0.2775), (10, 10, 0.7225, 1.0),
                                     (5, 10, 0.2366, 0.7634), (0, 1, 0.0, 0.7935)):
            found = share_interval(count, of)
            self.assertAlmostEqual(found[0], low, delta=1e-4)
            self.assertAlmostEqual(found[1], high, delta=1e-4)


if __name__ == "__main__":
    unittest.main()
