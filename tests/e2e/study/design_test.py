# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Designs of hapnet-study: what is read, what is refused, and the order of the trials."""

import collections
import itertools
import os
import random
import tempfile
import unittest

from hapnet.study.design import DesignError, read_design
from hapnet.study.plan import Plan, williams

GOOD = """title = "noticing delay in T1"
factor = "both.delay"
levels = ["0ms", "40ms", "80ms", "120ms", "160ms"]
question = "Did the two presses feel the same?"
noticed = "no"
repetitions = 10
task = "T1"
duration = "8s"
observer = { threshold = "80ms", slope = 4 }
"""
STAIRS = GOOD.replace(
    'levels = ["0ms", "40ms", "80ms", "120ms", "160ms"]',
    'staircase = { start = "160ms", step = "20ms", down = 2, up = 1, reversals = 8 }')
PAIRS = GOOD.replace('"0ms", ', "").replace('question = "Did the two presses feel the same?"',
                                            "two_intervals = true")


def read(text):
    with tempfile.NamedTemporaryFile("wb", suffix=".toml") as file:
        file.write(text if isinstance(text, bytes) else text.encode())
        file.flush()
        try:
            return read_design(file.name)
        except DesignError as wrong:
            raise DesignError(str(wrong).replace(file.name, "FILE")) from None


def trials_of(design, participant, answer=lambda trial: trial.level > 80.0):
    plan, trials = Plan(design, participant), []
    while (trial := plan.next()) is not None:
        trials.append(trial)
        plan.take(answer(trial))
    return trials


class ADesign(unittest.TestCase):
    def test_is_read_with_its_units(self):
        design = read(GOOD)
        self.assertEqual(design.levels, (0.0, 40.0, 80.0, 120.0, 160.0))
        self.assertEqual((design.unit, design.duration_s, design.observer.threshold),
                         ("ms", 8.0, 80.0))
        self.assertEqual(read(GOOD.replace('"0ms"', '"500us"')).levels[0], 0.5)
        self.assertEqual(read(GOOD.replace('"both.delay"', '"delay"')).factor, "both.delay")
        shares = GOOD.replace('delay"', 'loss"').replace("ms", "%")
        shares = shares.replace("120%", "90%").replace("160%", "99.5%")
        self.assertEqual(read(shares).levels[-1], 99.5)

    def test_has_other_settings_that_hold_in_every_trial(self):
        design = read(GOOD + 'conditions = { both.loss = "1%", up = { jitter = "5ms" } }\n')
        self.assertEqual(design.conditions, (("both.loss", "1%"), ("up.jitter", "5ms")))

    def test_names_the_place_the_reason_and_the_cure_of_a_mistake(self):
        for old, new, message in (
            ('factor = "both.delay"', 'factro = "x"', "FILE:2: factro: unknown key: did you mean "
             "'factor'?"),
            ('"40ms"', '"40"', "FILE:3: levels: '40' has no unit: write one of"),
            ('"40ms"', "40", "FILE:3: levels: 40 is no time: write it as a text"),
            ('"40ms"', '"40kg"', "FILE:3: levels: '40kg' has the unknown unit 'kg'"),
            ('"40ms"', '"40\\u0007s"', "FILE:3: levels: '40\\x07s' has the unknown unit '\\x07s'"),
            ("task =", '"\\u001b" =', "FILE: '\\x1b': unknown key: use title"),
            ('"40ms"', '"90ms"', "FILE:3: levels: 80ms comes after 90ms: write them ascending"),
            ('"both.delay"', '"both.dealy"', "FILE:2: factor: 'both.dealy' is no condition that "
             "gets worse as it grows: did you mean 'both.delay'?"),
            ('"both.delay"', '"both.rate"', "FILE:2: factor: 'both.rate' is no condition that"),
            ("repetitions = 10", "repetitions = 0", "FILE:6: repetitions: 0: write a whole number"),
            ("repetitions = 10", "repetitions = 10\nblocks = 3", "FILE:7: blocks: 10 repetitions"),
            ("repetitions = 10", "repetitions = true", "FILE:6: repetitions: True: write a whole"),
            ('"T1"', '"T99"', "FILE:7: task: 'T99' is unknown: use T1"),
            ('"8s"', '"8ms"', "FILE:8: duration: '8ms': write a time from 1s"),
            ('noticed = "no"', 'noticed = "maybe"', "FILE:5: noticed: 'maybe' is unknown"),
            ("slope = 4", "slpoe = 4", "FILE:9: observer.slpoe: unknown key: did you mean"),
            ('threshold = "80ms", ', "", "FILE: observer.threshold: it is missing"),
            ('"noticing delay in T1"', '"noticing', "FILE:1:"),
            ('question = "Did the two presses feel the same?"', "", "FILE: question: it is"),
            ("repetitions = 10", 'conditions = { both.delay = "1ms" }', "both.delay is the factor"),
        ):
            self.assertIn(old, GOOD)
            with self.assertRaises(DesignError) as refused:
                read(GOOD.replace(old, new, 1))
            self.assertIn(message, str(refused.exception))
        for text, message in (
            (GOOD.replace("levels", "#levels"), "write either levels or staircase"),
            (STAIRS + 'levels = ["0ms", "1ms"]\n', "there is a staircase, too"),
            (STAIRS.replace('"20ms"', '"0ms"'), "staircase.step: a step has to be more"),
            (STAIRS.replace("down = 2", 'lowest = "170ms"'), "staircase.start: it has to lie"),
            (PAIRS.replace('"40ms"', '"0ms"'), "levels: 0ms is the reference"),
            (b"\xff", "it is no UTF-8 text"),
            ("a = " + "[" * 5000, "nested too deep"),
        ):
            with self.assertRaises(DesignError) as refused:
                read(text)
            self.assertIn(message, str(refused.exception))

    def test_of_any_bytes_is_read_or_refused(self):
        draw = random.Random(7)
        accepted = 0
        for _ in range(1500):
            text = bytearray(draw.choice((GOOD, STAIRS, PAIRS)).encode())
            for _ in range(draw.randint(1, 4)):
                at = draw.randrange(len(text))
                text[at:at + draw.randrange(3)] = draw.choice(
                    (b"", b"-", b"0", b"9" * 30, b"\xff", b"[", b"{", b'"', b"\n", b"nan", b"="))
            try:
                design = read(bytes(text))
            except DesignError as refused:
                self.assertTrue(str(refused).startswith("FILE"), refused)
            else:
                accepted += 1
                self.assertIsNotNone(Plan(design, 1).next())
        self.assertGreater(accepted, 20)


class TheOrder(unittest.TestCase):
    def test_is_the_same_for_the_same_number_and_another_for_the_next(self):
        for text in (GOOD, STAIRS, PAIRS):
            design = read(text)
            self.assertEqual(trials_of(design, 7), trials_of(design, 7))
            self.assertNotEqual(trials_of(design, 7), trials_of(design, 8))

    def test_has_every_level_as_often_as_the_design_says(self):
        trials = trials_of(read(GOOD), 3)
        self.assertEqual(set(collections.Counter(one.level for one in trials).values()), {10})
        self.assertEqual([one.number for one in trials], list(range(1, 51)))

    def test_is_balanced_in_places_and_in_followers(self):
        for levels in range(2, 9):
            rows = williams(levels)
            for place in range(levels):
                column = collections.Counter(row[place] for row in rows)
                self.assertEqual(set(column.values()), {len(rows) // levels})
            pairs = collections.Counter(pair for row in rows for pair in zip(row, row[1:]))
            self.assertEqual(len(pairs), levels * (levels - 1))
            self.assertEqual(len(set(pairs.values())), 1)

    def test_has_blocks_with_equal_parts_and_catch_trials_in_each(self):
        trials = trials_of(read(GOOD + "blocks = 2\ncatch_trials = 3\n"), 5)
        for block in (1, 2):
            own = [one for one in trials if one.block == block]
            self.assertEqual(sum(one.is_catch for one in own), 3)
            levels = collections.Counter(one.level for one in own if not one.is_catch)
            self.assertEqual(set(levels.values()), {5})
        places = [tuple(one.number for one in trials_of(
            read(GOOD + "catch_trials = 3\n"), who) if one.is_catch) for who in (1, 2, 3)]
        self.assertEqual(len(set(places)), 3)

    def test_puts_the_worse_interval_first_as_often_as_second(self):
        first = second = 0
        for participant in range(1, 5):
            design = read(PAIRS.replace("repetitions = 10", "repetitions = 8"))
            trials = trials_of(design, participant)
            for level in (40.0, 80.0, 120.0, 160.0):
                own = [one.worse for one in trials if one.level == level]
                self.assertEqual(own.count(1), 4)
            first += trials[0].worse == 1
            second += trials[0].worse == 2
        self.assertTrue(first and second)

    def test_of_a_staircase_goes_down_after_two_and_up_after_one(self):
        one = read(STAIRS.replace("repetitions = 10", "repetitions = 1"))
        levels = [trial.level for trial in trials_of(one, 1, lambda trial: trial.level >= 80.0)]
        self.assertEqual(levels, [160, 160, 140, 140, 120, 120, 100, 100, 80, 80, 60,
                                  80, 80, 60, 80, 80, 60, 80, 80, 60, 80, 80])
        self.assertEqual(len({trial.staircase for trial in trials_of(read(STAIRS), 1)}), 10)

    def test_of_staircases_takes_turns_and_ends(self):
        design = read(STAIRS.replace("repetitions = 10", "repetitions = 2\nblocks = 2\n"
                                     "catch_trials = 2"))
        trials = trials_of(design, 2)
        self.assertEqual({one.staircase for one in trials if one.block == 2}, {2, None})
        always = trials_of(design, 2, lambda trial: True)
        self.assertEqual(sum(not one.is_catch for one in always), 400, "200 trials end each")
        turns = [one.staircase for one in trials_of(read(STAIRS), 1)]
        runs = [len(list(group)) for _, group in itertools.groupby(turns)]
        self.assertLess(max(runs), 8)


if __name__ == "__main__":
    unittest.main()
