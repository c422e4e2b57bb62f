# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""A whole study with the real daemons and simulated devices. HAPNET_BIN is their folder,
HAPNET_REPOSITORY the clone."""

import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from hapnet import Lab, read_record
from hapnet.study.answers import folder_of

from terminal import PROGRAM, WITHIN_S, Terminal

DESIGN = """title = "a whole study"
factor = "both.delay"
levels = ["20ms", "200ms"]
two_intervals = true
repetitions = 1
task = "T1"
duration = "1500ms"
conditions = { both.loss = "1%" }
observer = { threshold = "80ms", slope = 4 }
"""


class AStudy(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="hapnet-study-")
        self.design = os.path.join(self.folder, "design.toml")
        with open(self.design, "w") as file:
            file.write(DESIGN)
        self.own = folder_of(self.folder, 7)
        self.answers = os.path.join(self.own, "answers.jsonl")
        # A busy machine makes sessions that are not valid; these trials are marked here.
        self.words = [sys.executable, PROGRAM, "run", self.design, "--participant", "07", "--out",
                      self.folder, "--observer", "simulated", "--keep-invalid"]

    def tearDown(self):
        shutil.rmtree(self.folder)

    def lines(self):
        with open(self.answers) as file:
            return [json.loads(line) for line in file]

    def test_is_killed_goes_on_and_is_analysed(self):
        killed = subprocess.Popen(self.words, stdout=subprocess.DEVNULL)
        self.await_first_record()
        killed.send_signal(signal.SIGKILL)
        killed.wait()
        self.assertEqual(len(self.lines()), 1, "the head, and no answer")
        done = subprocess.run(self.words, capture_output=True, text=True, timeout=WITHIN_S)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("ms", done.stdout, "the condition is hidden")
        answers = self.lines()[1:]
        self.assertEqual([one["trial"] for one in answers], [1, 2])
        for one in answers:
            self.assertEqual(len(one["records"]), 4)
            self.assertEqual(len(one["discrepancy_mm"]), 2)
            for name in one["records"]:
                self.assertNotIn("20", name)
                self.assertTrue(read_record(os.path.join(self.own, name)).ticks.rows)
        late = next(one for one in answers if one["level"] == "200ms")
        delays = [self.delay_of(late, interval) for interval in (1, 2)]
        worse = late["worse"] - 1
        self.assertGreaterEqual(delays[worse], 199.0)
        self.assertLess(delays[1 - worse], 199.0)
        said = subprocess.run(
            [sys.executable, PROGRAM, "analyse", self.design, "--out", self.folder, "--json"],
            capture_output=True, text=True, timeout=WITHIN_S)
        result = json.loads(said.stdout)
        self.assertEqual(result["participants"][0]["trials"], 2)

    def delay_of(self, answer, interval):
        names = [name for name in answer["records"] if f"-{interval}-" in name]
        analysis = Lab().analyse(*(os.path.join(self.own, name) for name in names))
        return analysis["a_to_b"]["delay_ms"]["p50"]

    def test_is_played_by_hand_and_enter_ends_the_force(self):
        words = [word for word in self.words[2:] if word not in ("--observer", "simulated")]
        person = Terminal(*words)
        person.until("Enter goes on: ")
        person.type("\n")
        person.until("interval 1 of 2")
        self.await_first_record()
        person.type("\n")
        person.until("Stopped: no force. The trial is played again. Enter goes on: ")
        person.type("\n")
        for answer in ("1", "2"):
            person.until("[1/2] ")
            person.type(answer + "\n")
        person.until("are answered:")
        person.until("no such text")
        self.assertEqual(person.close(), 0)
        stopped, *answers = self.lines()[1:]
        self.assertEqual(stopped, {"trial": 1, "invalid_because": ["emergency stop"]})
        self.assertEqual([one["answer"] for one in answers], ["1", "2"])
        self.assertNotIn("0ms", person.said)

    def test_refuses_what_the_programs_would_refuse_before_the_first_trial(self):
        for old, new, message in (
            ('both.loss = "1%"', 'both.los = "1%"', "conditions: hapnet-emulator ended with 2"),
            ('task = "T1"', 'algorithm = "bsae"', "algorithm: hapnet-peer ended with 2"),
            ('task = "T1"', 'scene = "papre"', "scene: hapnet-lab ended with 2"),
        ):
            with open(self.design, "w") as file:
                file.write(DESIGN.replace(old, new))
            done = subprocess.run(self.words, capture_output=True, text=True, timeout=WITHIN_S)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(message, done.stderr)
            self.assertFalse(os.path.exists(self.own))

    def await_first_record(self):
        first = os.path.join(self.own, "trial-0001-1-a.rec")
        end = time.monotonic() + WITHIN_S
        while not os.path.exists(first) and time.monotonic() < end:
            time.sleep(0.05)

    def test_stops_its_daemons_at_ctrl_c(self):
        run = subprocess.Popen(self.words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                               text=True, start_new_session=True)
        self.await_first_record()
        run.send_signal(signal.SIGINT)
        said = run.communicate(timeout=WITHIN_S)[1]
        self.assertEqual(run.returncode, 130, said)
        self.assertIn("the same command goes on", said)
        with self.assertRaises(ProcessLookupError):  # none of its group is left
            os.killpg(run.pid, 0)
        self.assertEqual(len(self.lines()), 1)


if __name__ == "__main__":
    unittest.main()
