# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""hapnet-study as a program, without sessions (--dry): at a terminal, killed, interrupted, with
damaged files. HAPNET_REPOSITORY is the clone."""

import json
import math
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import xml.dom.minidom

from hapnet import read_csv
from hapnet.study.analyse import read_answers
from hapnet.study.answers import AnswersError, folder_of
from hapnet.study.design import read_design
from hapnet.study.figure import svg

from terminal import PROGRAM, WITHIN_S, Terminal

DESIGN = """factor = "both.delay"
levels = ["0ms", "40ms", "80ms", "120ms", "160ms"]
question = "Did you notice a delay?"
repetitions = 4
blocks = 2
break = "90s"
catch_trials = 1
observer = { threshold = "80ms", slope = 4 }
"""
TRIALS = 22


def closed(schema):
    """The same schema, to which keys that it does not list are errors."""
    if isinstance(schema, list):
        return [closed(one) for one in schema]
    if not isinstance(schema, dict):
        return schema
    copy = {key: closed(value) for key, value in schema.items()}
    return {"additionalProperties": False, **copy} if "properties" in copy else copy


class AStudy(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="hapnet-study-")
        self.design = os.path.join(self.folder, "design.toml")
        self.out = os.path.join(self.folder, "out")
        with open(self.design, "w") as file:
            file.write(DESIGN)

    def tearDown(self):
        shutil.rmtree(self.folder)

    def words(self, participant, *more):
        return ["run", self.design, "--participant", str(participant), "--out", self.out, "--dry",
                *more]

    def run_program(self, *words, code=0):
        done = subprocess.run([sys.executable, PROGRAM, *words], stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, timeout=WITHIN_S)
        self.assertEqual(done.returncode, code, done.stderr + done.stdout)
        return done.stdout + done.stderr

    def simulate(self, participant, code=0):
        return self.run_program(*self.words(participant, "--observer", "simulated"), code=code)

    def lines(self, participant):
        path = os.path.join(folder_of(self.out, participant), "answers.jsonl")
        with open(path) as file:
            return [json.loads(line) for line in file]

    def expect_whole(self, participant):
        trials = [line["trial"] for line in self.lines(participant)[1:]]
        self.assertEqual(trials, list(range(1, TRIALS + 1)))

    def test_is_played_by_hand_and_shows_no_condition(self):
        person = Terminal(*self.words(1))
        asked = 0
        while True:
            came = person.until("Enter goes on: ", "[yes/no] ", "are answered:")
            if came == "are answered:":
                break
            if came == "[yes/no] ":
                asked += 1
                person.type("perhaps\n" if asked == 3 else "Y\n" if asked % 2 else "no\n")
            else:
                person.type("\n")
        person.until("no such text")
        self.assertEqual(person.close(), 0)
        self.assertEqual(asked, TRIALS + 1, "one answer was refused")
        self.assertIn("Please answer yes or no.", person.said)
        self.assertIn("A break: 90 s", person.said)
        self.assertIn(f"Trial {TRIALS} of {TRIALS}", person.said)
        self.assertNotIn("0ms", person.said)
        self.expect_whole(1)
        manifest = os.path.join(folder_of(self.out, 1), "manifest.json")
        with open(manifest) as file:
            self.assertTrue(json.load(file)["complete"])

    def test_loses_and_repeats_nothing_when_it_is_killed(self):
        draw = random.Random(11)
        noted, kills = 0, 0
        while True:
            person = Terminal(*self.words(1))
            patience = draw.randint(2, 9)  # texts, then kill -9
            while patience:
                came = person.until("Enter goes on: ", "[yes/no] ", "Noted.", "are answered:")
                noted += came == "Noted."
                patience -= 1
                if came in ("", "are answered:"):
                    break
                if came != "Noted.":
                    person.type("yes\n" if came == "[yes/no] " else "\n")
                    if not patience:
                        time.sleep(draw.random() * 0.02)
            person.process.send_signal(signal.SIGKILL)
            ended = came == "are answered:"
            person.close()
            answered = len(self.lines(1)) - 1
            # The last answer may be on the disk before the program could report it.
            self.assertIn(answered - noted, (0, 1), person.said)
            noted = answered
            if ended:
                break
            kills += 1
        self.assertGreater(kills, 2)
        self.expect_whole(1)

    def test_goes_on_after_ctrl_c_and_says_so(self):
        person = Terminal(*self.words(1))
        person.until("Enter goes on: ")
        person.type("\n")
        person.until("[yes/no] ")
        person.type("yes\n")
        person.until("[yes/no] ")
        person.process.send_signal(signal.SIGINT)
        person.until("the same command goes on")
        person.until("no such text")
        self.assertEqual(person.close(), 130)
        self.assertEqual(len(self.lines(1)), 2)
        self.assertIn("the input ended", self.run_program(*self.words(1), code=1))

    def test_answers_before_a_cut_line_are_kept(self):
        self.simulate(1)
        whole = self.lines(1)
        path = os.path.join(folder_of(self.out, 1), "answers.jsonl")
        for cut in (1, 40, 500, 1111):
            with open(path, "r+b") as file:
                file.truncate(os.path.getsize(path) - cut)
            self.simulate(1)
            self.assertEqual([{**line, "answered_after_s": 0} for line in self.lines(1)[1:]],
                             [{**line, "answered_after_s": 0} for line in whole[1:]])

    def test_refuses_answers_that_are_none_and_another_design(self):
        self.simulate(1)
        path = os.path.join(folder_of(self.out, 1), "answers.jsonl")
        with open(path) as file:
            text = file.read()
        for bad in (text.replace('"yes"', '"perhaps"', 1), "\n" + text, text.replace("{", "[", 3),
                    text + text.splitlines()[-1] + "\n", text.replace('"40ms"', '"80ms"', 1)):
            with open(path, "w") as file:
                file.write(bad)
            self.assertIn("answers.jsonl:", self.simulate(1, code=2))
            self.run_program("analyse", self.design, "--out", self.out, code=2)
        with open(path, "w") as file:
            file.write(text)
        self.assertIn("'simulated'", self.run_program(*self.words(1), code=2))
        with open(self.design, "a") as file:
            file.write("seed = 2\n")
        self.assertIn("the design has changed", self.simulate(1, code=2))

    def test_reads_or_refuses_answers_of_any_bytes(self):
        self.simulate(1)
        path = os.path.join(folder_of(self.out, 1), "answers.jsonl")
        with open(path, "rb") as file:
            whole = file.read()
        design, draw = read_design(self.design), random.Random(5)
        read = 0
        for _ in range(1000):
            data = bytearray(whole)
            for _ in range(draw.randint(1, 3)):
                at = draw.randrange(len(data))
                data[at:at + draw.randrange(4)] = draw.choice(
                    (b"", b"0", b"9" * 30, b"\xff", b"[", b"{", b'"', b"\n", b"\r", b"NaN"))
            with open(path, "wb") as file:
                file.write(data)
            try:
                answers, _, _ = read_answers(design, self.out, 1)
            except AnswersError as refused:
                self.assertRegex(str(refused), r"answers\.jsonl:\d+: .*: .*(--out|--participant)")
            else:
                read += 1
                self.assertEqual([one.trial.number for one in answers],
                                 list(range(1, len(answers) + 1)))
        self.assertGreater(read, 20)

    def test_lets_one_process_ask_a_participant(self):
        person = Terminal(*self.words(1))
        person.until("Enter goes on: ")
        self.assertIn("another hapnet-study", self.run_program(*self.words(1), code=2))
        person.close()

    def test_finds_thresholds_and_draws_them(self):
        self.simulate("1-6")
        said = self.run_program("analyse", self.design, "--out", self.out)
        self.assertIn("mean of", said)
        result = json.loads(self.run_program("analyse", self.design, "--out", self.out, "--json"))
        thresholds = [row["threshold"] for row in result["participants"]]
        self.assertAlmostEqual(result["all"]["threshold"], sum(thresholds) / 6, delta=1e-9)
        self.assertLess(result["all"]["ci_low"], 95.0)
        self.assertGreater(result["all"]["ci_high"], 65.0)
        for row in result["participants"]:
            self.assertLess(row["ci_low"], row["threshold"])
            self.assertGreater(row["ci_high"] or math.inf, row["threshold"])
        table = read_csv(os.path.join(self.out, "thresholds.csv"))
        self.assertEqual(table[-1]["participant"], "all")
        self.assertEqual([row["trials"] for row in table], [20] * 6 + [120])
        self.assertEqual(table[0]["catch_trials"], 2)
        levels = read_csv(os.path.join(self.out, "levels.csv"))
        self.assertEqual(sum(row["of"] for row in levels), 120)
        with open(os.path.join(self.out, "study.svg")) as file:
            drawing = file.read()
        self.assertEqual(drawing.count("<polyline"), 6)
        xml.dom.minidom.parseString(drawing)

    def test_draws_any_number_of_participants_within_the_figure(self):
        curve = {"location": 80.0, "scale": 20.0, "early": 0.0, "late": 0.0, "core": "logistic"}
        known = {"threshold": 80.0, "bound": "=", "ci_low": 60.0, "ci_high": 100.0, "curve": curve,
                 "levels": [{"level": 0.0, "noticed": 0, "of": 500}]}
        beyond = {**known, "threshold": 160.0, "bound": ">", "ci_high": None}
        below = {**known, "threshold": 0.0, "bound": "<", "ci_low": None}
        unknown = {**known, "threshold": None, "bound": None, "ci_low": None, "ci_high": None,
                   "curve": None}
        for rows in ([known], [unknown], [known, beyond, below, unknown], [known] * 500):
            rows = [{**row, "participant": i} for i, row in enumerate(rows, 1)]
            drawing = svg({"title": "<&>" * 300, "factor": "both.delay", "unit": "ms", "at": 0.5,
                           "participants": rows, "all": {"threshold": 80.0, "ci_low": None,
                                                         "ci_high": None}}, (0.0, 160.0), "share")
            root = xml.dom.minidom.parseString(drawing).documentElement
            self.assertLessEqual(int(root.getAttribute("height")), 760)
            dots = [float(one.getAttribute(key)) for one in root.getElementsByTagName("circle")
                    for key in ("cx", "cy")]
            self.assertGreater(min(dots), 20.0)
            self.assertLess(max(dots), 740.0)
            self.assertEqual(drawing.count("<circle"),
                             1 + len(rows) + sum(row["bound"] == "=" for row in rows))

    def test_writes_what_the_schemas_say(self):
        try:
            from jsonschema import Draft202012Validator
        except ImportError:
            self.skipTest("the module jsonschema is missing (Debian: python3-jsonschema)")
        self.simulate(1)
        result = self.run_program("analyse", self.design, "--out", self.out, "--json")
        noted = [{"trial": 3, "invalid_because": ["B: 3 % of the ticks missed"]}]
        played = [{**self.lines(1)[1], "records": ["a.rec"], "discrepancy_mm": [None],
                   "not_valid_because": []}]
        folder = os.path.join(os.environ["HAPNET_REPOSITORY"], "docs/formats/schemas")
        for name, documents in (("study", [json.loads(result)]),
                                ("study-answers", [*self.lines(1), *noted, *played])):
            with open(os.path.join(folder, f"{name}.schema.json")) as file:
                schema = closed(json.load(file))
            validator = Draft202012Validator(schema)
            for document in documents:
                self.assertEqual([one.message for one in validator.iter_errors(document)], [])
                self.assertFalse(validator.is_valid({**document, "no_such": 1}))
                for key in document:
                    less = {k: v for k, v in document.items() if k != key}
                    is_optional = name == "study-answers" and key in (
                        "records", "discrepancy_mm", "not_valid_because")
                    self.assertEqual(validator.is_valid(less), is_optional, f"without {key}")

    def test_warns_of_a_question_that_asks_for_the_opposite(self):
        self.simulate("1-3")
        with open(self.design, "a") as file:
            file.write('noticed = "no"\n')
        said = self.run_program("analyse", self.design, "--out", self.out)
        self.assertIn('write noticed = "yes"', said)

    def test_refuses_a_command_line_with_the_cure(self):
        for words, message in (
            (["run", self.design], "--participant: which number?"),
            (["run", self.design, "--participant", "Ann"], "no names are kept"),
            (["run", self.design, "--participant", "3-1"], "write a number from 1 to 9999"),
            (self.words("1-2"), "a range is for --observer simulated"),
            (["run", self.design, "--partcipant", "1"], "did you mean --participant?"),
            (["analyse", self.design, "--out", self.out + "-none"], "there is no such folder"),
            (["check", self.design + "x"], "there is no such file"),
            (["check", self.folder], "Is a directory: name a design"),
            ([], "which command?"),
            (["check", self.design, "--", "--id", "3"], "they go with run"),
            (self.words(1, "--device", "sim"), "--dry plays nothing"),
        ):
            self.assertIn(message, self.run_program(*words, code=2))

    def test_tells_what_the_system_refuses_with_the_place(self):
        own = os.path.join(folder_of(self.out, 1), "answers.jsonl")
        os.makedirs(own)
        for words in (["analyse", self.design, "--out", self.out], self.words(1)):
            self.assertIn(f"{own}: Is a directory: see to it", self.run_program(*words, code=3))

    def test_ends_without_a_word_when_no_one_reads_on(self):
        read, write = os.pipe()
        os.close(read)
        done = subprocess.run([sys.executable, PROGRAM, "check", self.design], stdout=write,
                              stderr=subprocess.PIPE, text=True, timeout=WITHIN_S)
        os.close(write)
        self.assertEqual((done.returncode, done.stderr), (3, ""))

    def test_tells_what_would_be_played(self):
        said = self.run_program("check", self.design, "--participant", "3")
        self.assertIn("22 trials of 1 session", said)
        said = self.run_program("check", self.design, "--json")
        plan, _ = json.JSONDecoder().raw_decode(said)  # warnings may follow
        self.assertEqual(len(plan["order"]), TRIALS)
        self.assertEqual(plan["trials"], TRIALS)


if __name__ == "__main__":
    unittest.main()
