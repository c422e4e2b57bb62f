# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""The normaliser keeps what is a promise, and nothing that is up to chance."""

import json
import unittest

from normal import (LINES_MAX, exact, masked, masked_numbers, page_of, shape_of_csv, shape_of_json,
                    shape_of_metrics)

STATISTICS = ('{"valid":true,"up":{"received":%d,"late_us":{"p50":%s,"max":%s},'
              '"dropped":{"mtu":0}},"others":[{"id":2,"name":"b"},'
              '{"id":3,"name":"c","age_ms":null}]}')
TABLE = """                   A to B      B to A
delay p50, ms       {:>7.3f}     {:>7.3f}
{} received, {} lost
"""
METRICS = """# HELP ticks_total Ticks of the loop
# TYPE ticks_total counter
ticks_total{{peer="{}"}} {}
ticks_total{{peer="{}"}} 7
# HELP late_seconds Lateness
# TYPE late_seconds gauge
late_seconds {}
"""


class Same(unittest.TestCase):
    """Two runs have the same normal text."""

    def test_json_of_other_values(self):
        self.assertEqual(shape_of_json(STATISTICS % (1, "6.25", "100.5"), units=True),
                         shape_of_json(STATISTICS % (99, "7.125", "1000.75"), units=True))

    def test_text_with_numbers_of_another_length_in_columns(self):
        self.assertEqual(masked_numbers(TABLE.format(5.25, 10, 3, 12)),
                         masked_numbers(TABLE.format(105.25, 1, 4321, 0)))

    def test_metrics_of_peers_in_another_order(self):
        self.assertEqual(shape_of_metrics(METRICS.format(1, 5, 2, "0.25")),
                         shape_of_metrics(METRICS.format(2, 50, 1, "6.5e-05")))

    def test_manifests_of_another_host_and_time(self):
        manifests = [json.dumps({"program": f"hapnet-lab 0.{n}.0 (commit {n}, GCC 1{n}.2)",
                                 "commit": str(n), "host": {"name": f"h{n}", "processors": n},
                                 "start": f"202{n}", "wall_time_s": n / 7}, indent=2)
                     for n in (1, 2)]
        self.assertNotEqual(*manifests)
        self.assertEqual(*map(masked, manifests))

    def test_lines_of_sessions_that_ended_in_another_order(self):
        self.assertEqual(exact('{"a":0}\n{"a":1}\n{"a":2}\n', "jsonl"),
                         exact('{"a":0}\n{"a":2}\n{"a":1}\n', "jsonl"))


class Different(unittest.TestCase):
    """A printer that was changed in one place changes the normal text."""

    def differ(self, normal, before, after):
        self.assertNotEqual(before, after)
        self.assertNotEqual(normal(before), normal(after))

    def test_each_change_of_json(self):
        whole = STATISTICS % (1, "6.25", "100.5")
        for old, new in (("received", "recieved"), ('"p50":6.25', '"p50":6'),
                         ('"p50":6.25', '"p50":"6.25"'), ('"p50":6.25', '"p50":null'),
                         (',"max":100.5', ""), ('"mtu":0', '"mtu":0,"more":0'),
                         ('"valid":true,', ""), (',"age_ms":null', ""),
                         ('"name":"b"', '"nome":"b"'),
                         ("true", '"yes"'), ('"p50":6.25,"max":100.5', '"max":100.5,"p50":6.25'),
                         ('[{"id":2,"name":"b"},', "[")):
            self.differ(shape_of_json, whole, whole.replace(old, new))

    def test_the_decimals_of_a_unit(self):
        before, after = (json.dumps({f"late_{n}_us": round(n / 7, decimals) for n in range(1, 9)})
                         for decimals in (3, 2))
        self.differ(lambda text: shape_of_json(text, units=True), before, after)

    def test_each_change_of_text(self):
        whole = TABLE.format(5.25, 10, 3, 12)
        for old, new in (("5.250", " 5.25"), ("ms", "us"), ("  A to B", "A to B  "),
                         ("received, ", "received "), ("\n", " \n")):
            self.differ(masked_numbers, whole, whole.replace(old, new, 1))

    def test_each_change_of_csv(self):
        whole = "time_s,mean_mm,tier\n0.100,,good\n0.200,5.25,usable\n"
        for old, new in (("mean_mm,tier", "tier,mean_mm"), ("time_s", "t_s"), ("0.100", "0.10"),
                         (",,", ",0,"), ("usable", "fair")):
            self.differ(shape_of_csv, whole, whole.replace(old, new))

    def test_each_change_of_metrics(self):
        whole = METRICS.format(1, 5, 2, "0.25")
        for old, new in (("Ticks of the loop", "Ticks"), ("gauge", "counter"), ("peer=", "id="),
                         ("late_seconds", "late_us"), (' 7', " 7.5")):
            self.differ(shape_of_metrics, whole, whole.replace(old, new))

    def test_a_digit_far_down_in_a_long_output(self):
        whole = "\n".join(f"{n},{n / 7:.3f}" for n in range(10 * LINES_MAX))
        self.differ(exact, whole, whole[:-1] + "9")
        self.differ(lambda text: exact(text, "json"), f"[{whole.replace(chr(10), ',')}]",
                    f"[{whole.replace(chr(10), ',')},5]")

    def test_what_a_page_shows_and_embeds(self):
        page = ("<h1>A run</h1><svg><text>1</text></svg><table><tr><th>mean</th><td>5.2</td></tr>"
                "</table><script type='application/json' id='figures'>[1]</script>")
        text, data = page_of(page)
        self.assertEqual((text, data), ("A run\nmean | 5.2\n", {"figures": "[1]"}))


if __name__ == "__main__":
    unittest.main()
