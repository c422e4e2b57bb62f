# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""The tables of the pages are those of their data files, and scripts/result_tables.py notices where
they are not.

    result_tables_test.py REPOSITORY
"""

import contextlib
import io
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

REPOSITORY = pathlib.Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(REPOSITORY / "scripts"))

import result_tables

RESULTS = REPOSITORY / "docs" / "results"
PAGES = [page for page in sorted(RESULTS.glob("*.md"))
         if "<!-- data:" in page.read_text(encoding="utf-8")]
FILES = sorted((RESULTS / "data").glob("*.json"))


def run(*arguments):
    """Exit code, stdout and stderr of the script."""
    out, errors = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
        code = result_tables.main([str(word) for word in arguments])
    return code, out.getvalue(), errors.getvalue()


def row(subject, value, **others):
    return {"case": "c", "subject": subject, "baseline": None, "metric": "p50_us", "value": value,
            "baseline_value": None, "ratio": None, "target": None, "direction": "max", "met": None,
            **others}


class Repository(unittest.TestCase):
    def test_pages_have_the_tables_of_their_data(self):
        self.assertIn(RESULTS / "benchmarks.md", PAGES)
        self.assertEqual(run("--check", *PAGES), (0, "", ""))

    def test_every_data_file_is_sound_and_named_by_a_page(self):
        code, out, errors = run("--print", *FILES)
        self.assertEqual((code, errors), (0, ""))
        pages = "".join(page.read_text(encoding="utf-8") for page in RESULTS.glob("*.md"))
        for file in FILES:
            self.assertIn(f"[{file.name}]", out)
            self.assertTrue(f"data/{file.name}" in pages or f"data: {file.name} " in pages, file)


class Pages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.page = pathlib.Path(folder.name) / "page.md"
        self.file = self.page.parent / "data" / "a.json"
        self.file.parent.mkdir()
        self.rows = [row("fast", 1.5, target=2, met=True), row("slow", None)]
        self.write("a.json")

    def write(self, words):
        data = {"commit": None, "date": "2026-11-26", "machine": None, "command": "run",
                "rows": self.rows}
        self.file.write_text(json.dumps(data), encoding="utf-8")
        self.page.write_text(f"before\n<!-- data: {words} -->\n<!-- end data -->\nafter\n",
                             encoding="utf-8")

    def table(self):
        self.assertEqual(run(self.page), (0, "", ""))
        text = self.page.read_text(encoding="utf-8")
        self.assertTrue(text.startswith("before\n<!-- data: ") and text.endswith("-->\nafter\n"))
        return [line for line in text.splitlines() if line.startswith("|")]

    def refusal(self):
        code, _, errors = run("--check", self.page)
        self.assertEqual(code, 2)
        return errors

    def test_a_table_has_a_column_for_each_subject(self):
        self.assertEqual(self.table(), ["| case | metric | fast | slow | target |",
                                        "| --- | --- | ---: | ---: | --- |",
                                        "| c | p50_us | 1.5 | – | ≤ 2 met |"])
        self.assertIn("[a.json](data/a.json): 2026-11-26; `run`.",
                      self.page.read_text(encoding="utf-8"))

    def test_subjects_without_a_common_case_share_a_column(self):
        self.rows[1]["case"] = "d"
        self.write("a.json")
        self.assertEqual(self.table()[2:], ["| c | p50_us | fast | 1.5 | ≤ 2 met |",
                                            "| d | p50_us | slow | – |  |"])

    def test_joined_metrics_share_a_line(self):
        self.rows += [row("fast", 7, metric="p99_us"), row("slow", 1234.5, metric="p99_us")]
        self.write("a.json joined")
        self.assertEqual(self.table()[2:],
                         ["| c | p50_us / p99_us | 1.5 / 7 | – / 1234 | ≤ 2 met |"])

    def test_baselines_stand_beside_what_is_compared_with_them(self):
        self.rows.append(row("fast", 1.5, metric="p50_us_ratio", baseline="slow", baseline_value=3,
                             ratio=2, target=5, direction="min", met=False))
        self.write("a.json baselines")
        self.assertEqual(self.table(), ["| case | metric | fast | slow | target |",
                                        "| --- | --- | ---: | ---: | --- |",
                                        "| c | p50_us | 1.5 | 3 (2x) | ≤ 2 met; "
                                        "≥ 5x **missed** against slow |"])

    def test_an_expression_chooses_the_rows(self):
        self.rows.append(row("fast", 3, case="d"))
        self.write("a.json cases: ^d, p50")
        self.assertEqual(self.table()[2:], ["| d | p50_us | 3 |"])
        self.write("a.json cases: ^e")
        self.assertIn("a.json: no row matches '^e'", self.refusal())

    def test_a_figure_that_differs_is_noticed(self):
        self.table()
        self.assertEqual(run("--check", self.page)[0], 0)
        text = self.page.read_text(encoding="utf-8")
        self.page.write_text(text.replace("| 1.5 |", "| 1.4 |"), encoding="utf-8")
        code, _, errors = run("--check", self.page)
        self.assertEqual(code, 1)
        self.assertIn(f"{self.page}: differs from its data: run ", errors)
        self.assertIn("| 1.4 |", self.page.read_text(encoding="utf-8"))
        self.assertIn("| c | p50_us | 1.5 | – | ≤ 2 met |", self.table())

    def test_wrong_data_is_refused_with_its_place(self):
        self.rows[0]["met"] = False
        self.write("a.json")
        self.assertIn("a.json: row 1: 'met' is False, but its figures say True", self.refusal())
        self.rows[0] = row("fast", 2, baseline="slow", baseline_value=3, ratio=2)
        self.write("a.json")
        self.assertIn("row 1: 'ratio' is 2, but its figures say 1.5", self.refusal())
        self.rows[0] = {"case": "c"}
        self.write("a.json")
        self.assertIn("row 1: its keys are case: write case, subject,", self.refusal())

    def test_a_table_without_an_end_is_refused(self):
        self.page.write_text("<!-- data: a.json -->\n", encoding="utf-8")
        self.assertIn("a table has no end", self.refusal())
        self.assertEqual(run()[0], 2)


class RowsOfATableOfResults(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)
        columns = [{"key": key} for key in ("algorithm", "task", "tier", "delay_ms")]
        table = {"columns": columns, "rows": [["base", "worst", "good", 50.5],
                                              ["base", "T1", "good", 70], ["sep", "worst", "good",
                                                                           None]]}
        (self.path / "results.json").write_text(json.dumps({"tables": {"needs": table}}),
                                                encoding="utf-8")
        (self.path / "manifest.json").write_text(json.dumps(
            {"commit": "abc", "start": "2026-01-02T03:04:05Z", "command": "run x",
             "host": {"processors": 3}}), encoding="utf-8")

    def rows(self, *words):
        return subprocess.run([REPOSITORY / "scripts/data_rows.py", self.path, *words],
                              capture_output=True, text=True, check=False)

    def test_become_a_data_file_that_can_be_printed(self):
        done = self.rows("needs", "--case", "tier,task", "--subject", "algorithm", "--metrics",
                         "delay_ms", "--where", "task=worst", "--command", "hapnet-lab run x")
        self.assertEqual(done.returncode, 0, done.stderr)
        data = json.loads(done.stdout)
        self.assertEqual([(one["case"], one["subject"], one["value"]) for one in data["rows"]],
                         [("good, worst", "base", 50.5)])
        self.assertEqual((data["date"], data["machine"], data["command"]),
                         ("2026-01-02", "3 processors", "hapnet-lab run x"))
        file = self.path / "needs.json"
        file.write_text(done.stdout, encoding="utf-8")
        code, table, _ = run("--print", file)
        self.assertEqual(code, 0)
        self.assertIn("| good, worst | delay_ms | 50.5 |", table)

    def test_say_which_key_or_table_is_missing(self):
        for words, said in ((("need",), "no table need: it has needs"),
                            (("needs",), "no key seeds: it has algorithm, task, tier, delay_ms")):
            done = self.rows(*words, "--case", "seeds", "--subject", "algorithm", "--metrics",
                             "task")
            self.assertEqual(done.returncode, 2)
            self.assertIn(said, done.stderr)


class LongTables(unittest.TestCase):
    """The rows that scripts/long_tables.py takes from made results."""

    LIMITS = "algorithm,impairment,task,{},limit,bound,unit,p50,ci_low,ci_high\n"

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)
        conventions = self.LIMITS.format("filter_order,hand")
        self.write("fig6a/limits_by_convention.csv", conventions +
                   "base,delay,T1,1,firm,170,=,ms,,,\nbase,delay,T2,1,firm,155,=,ms,,,\n"
                   "base,delay,T1,4,firm,99,=,ms,,,\n")
        self.write("fig6b/limits_by_convention.csv", conventions)
        for name in ("velocity-rule", "horizon", "jitter-order", "path-delay"):
            self.write(f"{name}/limits_by_axis.csv", self.LIMITS.format("value"))
        self.write("horizon/limits_by_axis.csv", self.LIMITS.format("value") +
                   "a,jitter,T1,none,3,=,ms,3,2,4\na,jitter,worst,none,20,>,ms,20,20,\n")
        self.write("plane/manifest.json", json.dumps(
            {"commit": "c", "start": "2026-11-26T10:00:00Z", "host": {"processors": 2}}))
        self.write("plane/qos.csv", "algorithm,task,delay_ms,jitter_ms,loss_percent,tier\n"
                   "a,T1,0,0,0,good\na,T1,9,0,0,usable\na,T2,0,0,0,usable\na,T2,9,0,0,unusable\n")
        self.write("any-network/sessions_by_point.csv", "point,algorithm,task,tier\n"
                   "1,a,P1,good\n1,a,T1,unusable\n")
        self.write("many/qos.csv", "algorithm,task,peers,delay_ms,tier\n" + "".join(
            f"a,T7,3,{delay},{tier}\n" for delay, tier in (
                (20, "unusable"), (0, "good"), (10, "usable"), (30, "good"))))
        precision = ("algorithm,task,figure,value,reference,seeds,found,difference,ci_low,ci_high,"
                     "error\n")
        self.write("work-precision/precision.csv", precision +
                   "a,T1,mean_mm,2ms,1ms,10,5,9,,,1\na,T1,mean_mm,2ms,1ms,20,5,0.5,0.4,0.6,1\n"
                   "a,T1,mean_mm,1ms,1ms,10,4,,,,0.25\na,T1,mean_mm,1ms,1ms,20,4.5,0,,,0\n")
        self.write("work-precision-limits/precision.csv", precision)
        done = subprocess.run([REPOSITORY / "scripts/long_tables.py", self.path], check=True,
                              capture_output=True, text=True)
        self.rows = [(row["case"], row["subject"], row["metric"], row["value"])
                     for row in json.loads(done.stdout)["rows"]]

    def write(self, name, text):
        path = self.path / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def of_case(self, beginning):
        return [row[1:] for row in self.rows if row[0].startswith(beginning)]

    def test_a_limit_is_that_of_the_task_with_the_lowest_one(self):
        self.assertEqual(self.of_case("by hand: base"), [("firm", "delay, ms", 155)])

    def test_a_limit_beyond_the_search_has_no_interval(self):
        self.assertEqual(self.of_case("horizon none: a"),
                         [("limit", "jitter, ms", 20), ("95 % from", "jitter, ms", None),
                          ("95 % to", "jitter, ms", None)])

    def test_networks_count_by_task_and_in_all(self):
        self.assertEqual(self.of_case("plane: a"),
                         [("T1", "usable networks", 2), ("T2", "usable networks", 1),
                          ("all tasks", "usable networks", 1), ("T1", "good networks", 1),
                          ("T2", "good networks", 0), ("all tasks", "good networks", 0)])
        self.assertEqual(self.of_case("any-network: a")[:2],
                         [("T1", "usable networks", 0), ("all tasks", "usable networks", 0)])

    def test_the_delay_of_hands_is_borne_like_every_shorter_one(self):
        self.assertEqual(self.of_case("hands: a"), [("3 hands", "T7 usable, ms", 10),
                                                    ("3 hands", "T7 good, ms", 0)])

    def test_errors_are_those_of_all_seeds(self):
        self.assertEqual(self.of_case("tick: a, T1, mean_mm"),
                         [("2ms", "difference", 0.5), ("2ms", "95 % from", 0.4),
                          ("2ms", "95 % to", 0.6), ("1ms", "error of ten seeds", 0.25),
                          ("1ms", "figure", 4.5)])


if __name__ == "__main__":
    unittest.main()
