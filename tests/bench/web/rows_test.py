# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""What the benches of the live page write has the keys of all benches, and tells what was met."""

import json
import os
import shutil
import subprocess
import unittest

import disturbance
from rows import row

HERE = os.path.dirname(os.path.abspath(__file__))
KEYS = ["case", "subject", "baseline", "metric", "value", "baseline_value", "ratio", "target",
        "direction", "met"]


class Rows(unittest.TestCase):
    def test_lateness_may_grow_by_a_twentieth_or_five_microseconds(self):
        # Alone, watched, whether that is met: of 20 us the 5 us count, of 200 us the 5 %.
        for alone, watched, is_met in [(20.0, 24.9, True), (20.0, 25.1, False),
                                       (200.0, 209.9, True), (200.0, 210.1, False)]:
            late, ratio = disturbance.late_rows("peer", watched, alone)
            self.assertEqual([list(late), list(ratio)], [KEYS, KEYS])
            self.assertEqual((late["metric"], ratio["metric"]), ("late_p99_us", "late_p99_ratio"))
            for one in (late, ratio):
                self.assertEqual((one["value"], one["baseline_value"]), (watched, alone))
                self.assertAlmostEqual(one["ratio"], alone / watched)
                self.assertEqual(one["met"], is_met, one)
            self.assertEqual((late["direction"], ratio["direction"]), ("max", "min"))
            self.assertAlmostEqual(late["target"], max(1.05 * alone, alone + 5.0))
            self.assertAlmostEqual(ratio["target"], alone / late["target"])

    def test_no_ratio_is_made_of_nothing(self):
        place = {"case": "c", "subject": "s", "baseline": "b"}
        none = row(place, "missed_ticks", 0, baseline_value=0, target=0)
        self.assertEqual((none["ratio"], none["met"]), (None, True))
        self.assertIsNone(row(place, "frames", 3)["met"])
        self.assertTrue(row(place, "late_ratio", 0, baseline_value=1, target=2,
                            direction="min")["met"])

    @unittest.skipUnless(shutil.which("node"), "needs node")
    def test_the_page_has_the_same_keys(self):
        script = ("import { rowOf } from './rows.mjs';"
                  "const row = { case: 'c', subject: 's', metric: 'first paint', unit: 'ms' };"
                  "console.log(JSON.stringify([[900, 1000], [1100, 1000], [7, null], [NaN, 3]]"
                  ".map(([value, target]) => rowOf({ ...row, value, target }))));")
        out = subprocess.run(["node", "--input-type=module", "-e", script], cwd=HERE, check=True,
                             capture_output=True, text=True).stdout
        rows = json.loads(out)
        for one in rows:
            self.assertEqual(list(one), KEYS)
        self.assertEqual([one["met"] for one in rows], [True, False, None, False])
        self.assertEqual((rows[0]["metric"], rows[3]["value"]), ("first paint, ms", None))


if __name__ == "__main__":
    unittest.main()
