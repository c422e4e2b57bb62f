# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""What those who watch cost the daemons: sessions of P1 at 160 ms with ten WebSocket readers and
without, in turn. The readers are of two hapnet-web, which take eight pages each. They stand for
browsers on other machines, so they give way to everything here (nice 19): how many frames they
took is printed. Twelve sessions of 30 s take seven minutes."""

import argparse
import json
import os
import platform
import statistics
import subprocess
import sys
import tempfile
import threading
import time

from rows import row

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "../../e2e/web"))
from served import BIN, Live, Server  # noqa: E402  pylint: disable=wrong-import-position

READERS = 10
SHARE_MAX = 1.05
LATER_MAX_US = 5.0


def program(name):
    return os.path.join(BIN, name)


class Readers:
    """Live sockets that take every frame, in threads."""

    def __init__(self, sockets):
        arguments = ["--emulator", sockets[0], "--peer", sockets[1], "--peer", sockets[2]]
        self.servers = [Server(*arguments) for _ in range(2)]
        self.frames = 0
        self.is_over = False
        self.threads = [threading.Thread(target=self.read, args=(self.servers[i % 2],))
                        for i in range(READERS)]
        for thread in self.threads:
            thread.start()

    def read(self, server):
        os.setpriority(os.PRIO_PROCESS, threading.get_native_id(), 19)
        live = Live(server.port, server.token)
        while not self.is_over:
            message = live.read()
            if isinstance(message, dict) and message["type"] == "frame":
                self.frames += 1
        live.close()

    def stop(self):
        self.is_over = True
        for thread in self.threads:
            thread.join()
        for server in self.servers:
            server.stop()


def session(seconds, is_watched):
    """Lateness (p99, us) and missed ticks of one session; frames that were read."""
    with tempfile.TemporaryDirectory() as folder:
        sockets = [f"{folder}/{name}.sock" for name in ("emulator", "peer-1", "peer-2")]
        records = [f"{folder}/{i}.rec" for i in (1, 2)]
        emulator = subprocess.Popen(
            [program("hapnet-emulator"), "--listen-a", "127.0.0.1:0", "--listen-b", "127.0.0.1:0",
             "--delay", "160ms", "--control", sockets[0], "--stats", f"{folder}/emulator.json"],
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        words = dict(word.split("=", 1) for word in emulator.stdout.readline().split()
                     if "=" in word)
        peers = [subprocess.Popen(
            [program("hapnet-peer"), "--id", str(i), "--remote", words[side], "--task", "P1",
             "--duration", f"{seconds}s", "--control", sockets[i], "--record", records[i - 1]],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            for i, side in ((1, "a"), (2, "b"))]
        readers = Readers(sockets) if is_watched else None
        for peer in peers:
            peer.wait()
        frames = readers.frames if readers else 0
        if readers:
            readers.stop()
        emulator.terminate()
        emulator.wait()
        emulator.stdout.close()
        analysis = json.loads(subprocess.run(
            [program("hapnet-lab"), "analyse", *records, "--json"], check=True,
            capture_output=True).stdout)
        with open(f"{folder}/emulator.json", encoding="utf8") as file:
            stats = json.load(file)
    return {"peer": max(analysis[side]["tick"]["late_us"]["p99"] for side in ("a", "b")),
            "emulator": max(stats[way]["lateness_us"]["p99"] for way in ("up", "down")),
            "missed": sum(analysis[side]["tick"]["missed"] for side in ("a", "b")),
            "frames": frames}


def place_of(subject):
    return {"case": f"P1 at 160 ms, {READERS} readers", "subject": subject,
            "baseline": "no readers"}


def late_rows(subject, watched, alone):
    """Of the p99 of lateness, medians over the sessions in us: 5 % or 5 us more are met. The same
    bound as a time and, from the other side, as the ratio of the time without readers to it."""
    most = max(SHARE_MAX * alone, alone + LATER_MAX_US)
    place = place_of(subject)
    return [row(place, "late_p99_us", watched, baseline_value=alone, target=most),
            row(place, "late_p99_ratio", watched, baseline_value=alone, target=alone / most,
                direction="min")]


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--quick", action="store_true", help="two short sessions of each kind")
    options.add_argument("--json", metavar="FILE", help="write the rows there")
    chosen = options.parse_args()
    seconds, rounds = (8, 2) if chosen.quick else (30, 6)
    found = {False: [], True: []}
    load = os.getloadavg()[0]
    for i in range(rounds):
        for is_watched in (False, True) if i % 2 == 0 else (True, False):
            one = session(seconds, is_watched)
            found[is_watched].append(one)
            print(f"{'readers' if is_watched else 'alone':8} late p99: "
                  f"peers {one['peer']:7.1f} us, emulator {one['emulator']:7.1f} us; "
                  f"missed {one['missed']}", flush=True)
            time.sleep(0.2)

    def median(name, is_watched):
        return statistics.median(one[name] for one in found[is_watched])

    rows = [one for subject in ("peer", "emulator")
            for one in late_rows(subject, median(subject, True), median(subject, False))]
    missed = {way: sum(one["missed"] for one in found[way]) for way in found}
    rows.append(row(place_of("peers"), "missed_ticks", missed[True], baseline_value=missed[False],
                    target=missed[False]))
    frames = median("frames", True) / READERS / seconds
    for one in (one for one in rows if one["metric"] == "late_p99_us"):
        watched, alone = one["value"], one["baseline_value"]
        print(f"{one['subject']:9} late p99 {watched:9.1f} us, without readers {alone:9.1f} us, "
              f"{watched / alone:.3f} times that (at most {SHARE_MAX}, or {LATER_MAX_US:g} us "
              f"more)  {'met' if one['met'] else 'MISSED'}")
    print(f"peers     ticks missed {missed[True]}, without readers {missed[False]}  "
          f"{'met' if rows[-1]['met'] else 'MISSED'}")
    print(f"each reader took {frames:.0f} frames a second; medians of {rounds} sessions of "
          f"{seconds} s each way, in turn; load at the beginning {load:.1f}")
    if chosen.json:
        host = {"machine": platform.platform(), "processors": os.cpu_count(), "load": load}
        with open(chosen.json, "w", encoding="utf8") as file:
            json.dump({"host": host, "rows": rows}, file, indent=1)
            file.write("\n")


if __name__ == "__main__":
    main()
