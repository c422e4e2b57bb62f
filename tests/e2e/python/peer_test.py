# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""The peer in Python (examples/python/peer.py) plays T1 with hapnet-peer: do the copies agree?"""

import bisect
import csv
import os
import subprocess
import sys
import tempfile
import unittest

from hapnet import Peer, read_record
from programs_test import free_port

EXAMPLE = os.path.join(os.environ["HAPNET_REPOSITORY"], "examples", "python", "peer.py")
DURATION_S = 12


class APeerInPython(unittest.TestCase):
    def test_agrees_with_the_daemon_about_the_cube(self):
        with tempfile.TemporaryDirectory() as folder:
            record, table = os.path.join(folder, "a.rec"), os.path.join(folder, "b.csv")
            ports = free_port(), free_port()
            other = subprocess.Popen(
                [sys.executable, EXAMPLE, str(ports[1]), f"127.0.0.1:{ports[0]}", table]
            )
            try:
                daemon = Peer(
                    id=1, listen=f"127.0.0.1:{ports[0]}", remote=f"127.0.0.1:{ports[1]}",
                    task="T1", record=record, duration=f"{DURATION_S}s",
                )  # fmt: skip
                daemon.start()
                daemon.join(60.0)
                self.assertEqual(other.wait(10.0), 0)
            finally:
                other.kill()
                other.wait()
            self.check(read_record(record), table)

    def check(self, record, table):
        with open(table, encoding="utf-8") as file:
            rows = [(int(row["boottime_ns"]), float(row["x_m"]), float(row["force_n"]))
                    for row in csv.DictReader(file)]  # fmt: skip
        times = [row[0] for row in rows]
        start = record.sessions.rows[-1][0]
        apart, pushed, own, settled = [], 0, 0, []
        for tick in record.ticks.dicts():
            at = tick["due"] + tick["late"]
            near = bisect.bisect(times, at) - 1
            if near < 0 or at - times[near] > 100_000_000 or tick["phase"] not in (2, 3):
                continue
            apart.append(1e3 * abs(tick["cube"][0] - rows[near][1]))
            pushed += tick["remote_touching"]
            own += tick["touching"]
            if at - start > (DURATION_S - 1) * 1_000_000_000:
                settled.append(apart[-1])
        travelled = 1e3 * (max(row[1] for row in rows) - min(row[1] for row in rows))
        print(f"{len(apart)} ticks: {sum(apart) / len(apart):.3f} mm apart on average, "
              f"{max(apart):.3f} mm at most, {max(settled):.4f} mm at the end; the cube "
              f"travelled {travelled:.0f} mm")  # fmt: skip
        # Both hands moved the cube by turns, far enough that independent copies would differ.
        self.assertGreater(own, 500)
        self.assertGreater(pushed, 500)
        self.assertGreater(travelled, 30.0)
        # On a loaded machine either side may be late by tens of milliseconds, at 0.25 m/s.
        self.assertLess(sum(apart) / len(apart), 5.0)
        # Hands off: both have had a second or more to agree.
        self.assertLess(max(settled), 0.1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
