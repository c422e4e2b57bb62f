# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""The programs, driven from Python. HAPNET_BIN is their folder."""

import csv
import io
import os
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest

from hapnet import Emulator, Lab, Peer, ProgramFailed, Refused, read_record
from hapnet.process import run


class Echo(threading.Thread):
    """A server that answers every datagram with itself."""

    def __init__(self):
        super().__init__(daemon=True)
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.address = "%s:%d" % self.socket.getsockname()
        self.start()

    def run(self):
        while True:
            data, sender = self.socket.recvfrom(2048)
            if data == b"end":
                return
            self.socket.sendto(data, sender)

    def end(self):
        self.socket.sendto(b"end", self.socket.getsockname())
        self.join()
        self.socket.close()


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


class AnEmulator(unittest.TestCase):
    def setUp(self):
        self.server = Echo()
        self.client = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.client.settimeout(10.0)

    def tearDown(self):
        self.client.close()
        self.server.end()

    def test_delays_what_passes_and_counts_it(self):
        with Emulator(upstream=self.server.address, delay="40ms", seed=7) as network:
            for number in range(5):
                self.client.sendto(b"%d" % number, network.address)
                self.assertEqual(self.client.recv(100), b"%d" % number)
            self.assertTrue(network.wait("up.delivered>=5"))
            stats = network.stats()
            self.assertEqual(stats["up"]["received"], 5)
            self.assertEqual(stats["seed"], 7)
            self.assertIn("40ms", network.show()["profile"])

    def test_changes_its_conditions_and_goes_back(self):
        with Emulator(upstream=self.server.address) as network:
            network.set(up_loss="100%")
            self.client.sendto(b"lost", network.address)
            self.assertTrue(network.wait("up.dropped.random_loss>=1"))
            network.reset()
            self.client.sendto(b"there", network.address)
            self.assertEqual(self.client.recv(100), b"there")
            with self.assertRaisesRegex(Refused, "delya"):
                network.set(delya="5ms")
            self.assertFalse(network.wait("up.received>1000", timeout=0.1))
            watched = network.control.watch(every=0.05)
            self.assertEqual(next(watched)["up"]["received"], 2)
            self.assertEqual(next(watched)["up"]["received"], 2)

    def test_says_why_it_does_not_start(self):
        with self.assertRaisesRegex(ProgramFailed, "40") as failed:
            Emulator(upstream=self.server.address, delay="40").start()
        self.assertEqual(failed.exception.code, 2)

    def test_between_two_has_two_addresses(self):
        with Emulator(down_delay="1ms") as network:
            self.assertNotEqual(network.address_a, network.address_b)
            self.assertTrue(network.is_running())
        self.assertFalse(network.is_running())


class TwoPeers(unittest.TestCase):
    def test_leave_records_that_are_read_as_the_lab_reads_them(self):
        with tempfile.TemporaryDirectory() as folder:
            records = [os.path.join(folder, name) for name in ("a.rec", "b.rec")]
            with Emulator(delay="5ms") as network:
                ends = ["%s:%d" % network.address_a, "%s:%d" % network.address_b]
                peers = [
                    Peer(id=number + 1, listen=f"127.0.0.1:{free_port()}", remote=ends[number],
                         task="T3", duration="3s", record=records[number])
                    for number in (0, 1)
                ]  # fmt: skip
                for peer in peers:
                    peer.start()
                self.assertTrue(peers[0].wait("messages.states_received>100", timeout=20.0))
                self.assertEqual(peers[0].show()["task"], "T3")
                for peer in peers:
                    peer.join(30.0)
            analysis = Lab().analyse(*records)
            self.assertGreater(analysis["a_to_b"]["received"], 100)
            self.compare_with_export(records[0])

    def compare_with_export(self, path):
        record = read_record(path)
        text = run("hapnet-lab", ["export", path, "--csv"])
        rows = list(csv.DictReader(io.StringIO(text)))
        self.assertEqual(len(rows), len(record.ticks))
        self.assertFalse(record.cut_off)
        self.assertEqual(record.config["peer_id"], 1)
        times = record.time_s()
        moved = 0
        for row, tick, time in zip(rows, record.ticks.flat(), times):
            self.assertAlmostEqual(float(row["hip_x_mm"]), 1e3 * tick["hip_x"], places=3)
            self.assertAlmostEqual(float(row["time_s"]), time, places=5)
            moved += abs(tick["hip_x"]) > 0
        self.assertGreater(moved, 100)
        self.assertEqual(len(record.messages.column("bytes")[0]), 117)  # a hello comes first


class AScript(unittest.TestCase):
    """Programs that a script has started from a thread of its own, which has ended."""

    text = """
import sys, threading
from hapnet import Emulator
network = Emulator(delay="1ms")
starter = threading.Thread(target=network.start)
starter.start()
starter.join()
assert network.is_running()
print(network._process.pid, network.control_path, flush=True)
sys.stdin.read()
"""

    def test_leaves_no_program_behind_when_it_is_killed(self):
        script = subprocess.Popen(
            [sys.executable, "-c", self.text], stdin=subprocess.PIPE, stdout=subprocess.PIPE
        )
        number, path = script.stdout.readline().decode().split()
        emulator = int(number)
        self.assertTrue(os.path.exists(path))
        time.sleep(0.5)
        self.assertTrue(self.is_alive(emulator))
        script.kill()
        script.communicate()
        deadline = time.monotonic() + 20.0
        while self.is_alive(emulator):
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.05)
        self.assertFalse(os.path.exists(os.path.dirname(path)))

    def is_alive(self, pid):
        try:
            with open(f"/proc/{pid}/stat", encoding="ascii") as file:
                return file.read().rsplit(") ", 1)[1][0] != "Z"
        except FileNotFoundError:
            return False


class ALab(unittest.TestCase):
    def test_runs_an_experiment_and_reads_its_tables(self):
        with tempfile.TemporaryDirectory() as folder:
            text = """title = "small"
kind = "limits"
seeds = 1
algorithms = ["base"]
tasks = ["T1"]
duration = "6s"
[limit.delay]
to = "20ms"
step = "10ms"
resolution = "10ms"
"""
            experiment = os.path.join(folder, "small.toml")
            with open(experiment, "w", encoding="utf-8") as file:
                file.write(text)
            done = Lab(timeout=100.0).run(experiment, os.path.join(folder, "out"))
            rows = done.rows("limits.csv")
            self.assertEqual({row["algorithm"] for row in rows}, {"base"})
            self.assertEqual(rows[0]["unit"], "ms")
            self.assertIn("version", done.manifest)
            with self.assertRaises(ProgramFailed) as failed:
                Lab().run("no-such-experiment", folder)
            self.assertEqual(failed.exception.code, 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
