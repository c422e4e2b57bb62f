# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Curves, intervals and means of hapnet-study. HAPNET_REPOSITORY is the clone."""

import csv
import math
import os
import sys
import unittest

from hapnet.study.psychometric import TWO_INTERVALS, Count, Curve, fitted
from hapnet.student import mean_of, quantile_975

REPOSITORY = os.environ["HAPNET_REPOSITORY"]
sys.path.insert(0, os.path.join(REPOSITORY, "tests/soak"))
import study_soak  # noqa: E402


class TheFit(unittest.TestCase):
    def test_is_that_of_the_lab(self):
        # The results of hapnet-lab: tests/unit/lab/metrics compares the lab with the same table.
        with open(os.path.join(REPOSITORY, "tests/reference/psychometric.csv")) as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 37)
        for row in rows:
            levels, failed, of = ([float(one) for one in row[key].split()]
                                  for key in ("levels", "failed", "of"))
            curve = fitted([Count(*one) for one in zip(levels, failed, of)])
            self.assertAlmostEqual(curve.location, float(row["location"]), delta=1e-5)
            self.assertAlmostEqual(curve.scale, float(row["scale"]), delta=1e-5)
            self.assertEqual((curve.early, curve.late, curve.core),
                             (float(row["early"]), float(row["late"]), row["core"]))
            self.assertAlmostEqual(curve.level_of(0.5), float(row["p50"]), delta=1e-5)

    def test_finds_the_curve_that_guesses_are_mixed_with(self):
        truth = Curve(80.0, 20.0, 0.5, 0.0)
        levels = [20.0, 60.0, 100.0, 140.0, 180.0]
        counts = [Count(one, 1000 * truth.share_at(one), 1000) for one in levels]
        curve = fitted(counts, TWO_INTERVALS)
        self.assertEqual((curve.early, curve.late), (0.5, 0.0))
        self.assertAlmostEqual(curve.level_of(0.75), 80.0, delta=0.1)
        self.assertAlmostEqual(curve.share_at(curve.level_of(0.75)), 0.75, delta=1e-12)


class TheInterval(unittest.TestCase):
    def test_is_open_where_the_answers_do_not_bound_the_threshold(self):
        design = study_soak.design_of("levels, yes or no")
        none = [Count(level, 0, 10) for level in design.levels]
        low, high = study_soak.interval_of(design, none)
        self.assertGreater(low, 120.0)
        self.assertIsNone(high)

    def test_shrinks_as_the_root_of_the_trials(self):
        design = study_soak.design_of("levels, yes or no")
        truth = Curve(80.0, 20.0)
        widths = []
        for of in (100, 1600):
            counts = [Count(one, of * truth.share_at(one), of) for one in design.levels]
            low, high = study_soak.interval_of(design, counts)
            self.assertAlmostEqual(0.5 * (low + high), 80.0, delta=1.0)
            widths.append(high - low)
        self.assertAlmostEqual(widths[0] / widths[1], 4.0, delta=0.4)

    def test_holds_the_threshold_of_observers_by_all_methods(self):
        of = 60  # the soak plays 4000
        for name in study_soak.DESIGNS:
            design = study_soak.design_of(name)
            sides = [study_soak.held_by(design, study_soak.counts_by(design, one)[0])[0]
                     for one in range(1, of + 1)]
            self.assertTrue(study_soak.is_kept(sides.count(0), of), f"{name}: {sides}")

    def test_is_judged_by_a_judge_that_refuses_too_few_and_too_many(self):
        self.assertTrue(study_soak.is_kept(3800, 4000))
        self.assertFalse(study_soak.is_kept(3739, 4000))
        self.assertFalse(study_soak.is_kept(3861, 4000))
        self.assertFalse(study_soak.is_kept(45, 60))
        self.assertFalse(study_soak.is_kept(1000, 1000))


class Means(unittest.TestCase):
    def test_have_the_quantiles_of_students_tables(self):
        for degrees, t in ((1, 12.7062047), (2, 4.3026527), (9, 2.2621572), (30, 2.0422725)):
            self.assertAlmostEqual(quantile_975(degrees), t, delta=1e-6)

    def test_of_two_and_of_one(self):
        mean, low, high = mean_of([70.0, 90.0])
        self.assertEqual(mean, 80.0)
        self.assertAlmostEqual(high - mean, 12.7062047 * math.sqrt(200.0 / 2.0), delta=1e-4)
        self.assertAlmostEqual(mean - low, high - mean, delta=1e-9)
        self.assertEqual(mean_of([70.0]), (70.0, None, None))


if __name__ == "__main__":
    unittest.main()
