# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Regimes end to end: a relay whose way up is good and bad, judged by its fates, by the times at
which datagrams come out, and by what it says of itself.

Usage: regimes_test.py FOLDER-WITH-THE-PROGRAMS
"""

import json
import os
import pathlib
import re
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time

PROFILE = """
[[up.regime]]
name = "good"
stay = "200ms"
delay = "5ms"
[[up.regime]]
name = "bad"
stay = "100ms"
delay = "40ms"
loss = "30%"
"""
COUNT = 2000
SPACING = 0.002


def require(condition, text):
    if not condition:
        raise SystemExit(f"FAILED: {text}")


def bind():
    udp = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    udp.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 22)
    udp.bind(("127.0.0.1", 0))
    return udp


def rows(path):
    lines = pathlib.Path(path).read_text(encoding="utf-8").splitlines()
    head = lines[0].split(",")
    return head, [dict(zip(head, line.split(","))) for line in lines[1:]]


def ask(control, request):
    with socket.socket(socket.AF_UNIX) as stream:
        stream.connect(str(control))
        stream.sendall(json.dumps(request).encode() + b"\n")
        return json.loads(stream.makefile().readline())


class Run:
    """A relay with a profile; A sends COUNT datagrams to B, which notes how late each is."""

    def __init__(self, emulator, folder, name, profile, options=()):
        self.name, self.folder, self.came = name, folder, {}
        self.end_a, self.end_b = bind(), bind()
        file = folder / f"{name}.toml"
        file.write_text(profile, encoding="utf-8")
        self.control = folder / f"{name}.sock"
        self.process = subprocess.Popen(
            [emulator, "--listen-a", "127.0.0.1:0", "--listen-b", "127.0.0.1:0", "--profile",
             str(file), "--seed", "7", "--stats", str(folder / f"{name}.json"), "--fates",
             str(folder / f"{name}.csv"), "--control", str(self.control), *options],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        line = self.process.stdout.readline()
        require(line.startswith("ready"), line or self.process.stderr.read())
        ready = dict(word.split("=", 1) for word in line.split()[1:])
        self.to_a, self.to_b = (int(ready[side].rsplit(":", 1)[1]) for side in ("a", "b"))

    def receive(self):
        self.end_b.settimeout(1.0)
        try:
            while True:
                data = self.end_b.recv(100)
                number, sent = struct.unpack("<Id", data[:12])
                self.came[number] = time.monotonic() - sent
        except socket.timeout:
            pass

    def send(self, count=COUNT):
        self.end_b.sendto(b"here I am", ("127.0.0.1", self.to_b))
        time.sleep(0.1)
        receiver = threading.Thread(target=self.receive)
        receiver.start()
        begin = time.monotonic()
        for number in range(count):
            time.sleep(max(0.0, begin + number * SPACING - time.monotonic()))
            self.end_a.sendto(struct.pack("<Id", number, time.monotonic()),
                              ("127.0.0.1", self.to_a))
        receiver.join()

    def finish(self):
        self.process.terminate()
        _, said = self.process.communicate(timeout=10)
        require(self.process.returncode == 0, f"{self.name}: {self.process.returncode} {said}")
        self.end_a.close()
        self.end_b.close()
        head, fates = rows(self.folder / f"{self.name}.csv")
        statistics = json.loads((self.folder / f"{self.name}.json").read_text(encoding="utf-8"))
        return head, fates, statistics


def check_changes(run):
    """Live: by regime, and not where a regime hides it."""
    def change(key, value):
        return ask(run.control, {"command": "set", "settings": {key: value}})
    refused = change("up.delay", "9ms")
    require(not refused["ok"] and "up.regime.bad.delay" in refused["error"], refused)
    refused = change("up.regime.worse.delay", "9ms")
    require(not refused["ok"] and "there is no regime 'worse'" in refused["error"], refused)
    refused = ask(run.control, {"command": "apply", "profile": "", "file": "other.toml"})
    require(not refused["ok"] and "cannot change" in refused["error"], refused)
    done = change("up.regime.bad.loss", "40%")
    require(done["ok"] and done["changed"], done)
    shown = ask(run.control, {"command": "show"})["conditions"]["up.regime"]
    require('loss = "40%"' in shown, shown)
    metrics = json.dumps(ask(run.control, {"command": "metrics"}))
    require("hapnet_emulator_regime_share" in metrics, "no metric of regimes")


def check_run(emulator, folder):
    run = Run(emulator, folder, "first", PROFILE)
    run.send()
    told = ask(run.control, {"command": "stats"})
    require(set(told["up"]["regimes"]) == {"good", "bad"}, told["up"]["regimes"])
    head, fates, statistics = run.finish()
    require(head.index("regime") == head.index("states") + 1, f"columns {head}")
    up = [row for row in fates if row["direction"] == "up"]
    require(len(up) == COUNT, f"{len(up)} fates")
    late = {"good": 0.005, "bad": 0.040}
    for row in up:
        if row["verdict"] == "drop":
            require(row["regime"] == "bad", f"lost in {row}")
            continue
        asked = late[row["regime"]]
        require(row["delay_ns"] == str(round(asked * 1e9)), row)
    # The order is kept: what follows a bad stay waits for it.
    early = [n for n, delay in run.came.items() if delay < late[up[n]["regime"]]]
    require(not early, f"too early: {early[:5]}")
    shares = statistics["up"]["regimes"]
    require(abs(sum(one["share"] for one in shares.values()) - 1) < 1e-9, shares)
    met = sum(row["regime"] == "bad" for row in up) / COUNT
    require(abs(met - shares["bad"]["share"]) < 0.15 and 0.02 < met < 0.9, f"{met} of {shares}")
    require(shares["good"]["stays"] >= 2, shares)
    require("regimes" not in statistics["down"], "regimes where there are none")


def check_tools(emulator, folder):
    def done(*words):
        return subprocess.run([emulator, *words], capture_output=True, text=True, timeout=60,
                              check=False)
    stats = str(folder / "first.json")
    verified = done("verify", stats, "--rate", f"{1 / SPACING:g}")
    require(verified.returncode == 0, verified.stdout + verified.stderr)
    for test in ("regime good to bad", "regime bad stays", "regime bad, losses", "seed"):
        require(re.search(rf"^up +{test} ", verified.stdout, re.M),
                f"no {test}:\n{verified.stdout}")
    require("none deviates" in verified.stdout, verified.stdout)
    wrong = folder / "wrong.toml"
    wrong.write_text(PROFILE.replace("30%", "60%"), encoding="utf-8")
    verified = done("verify", stats, "--profile", str(wrong), "--rate", f"{1 / SPACING:g}")
    require(verified.returncode == 1, verified.stdout + verified.stderr)
    page = done("report", stats, "--out", str(folder / "page.html"))
    require(page.returncode == 0, page.stderr)
    text = (folder / "page.html").read_text(encoding="utf-8")
    require("regime bad" in text, "the page names no regime")
    checked = done("check", str(folder / "first.toml"))
    require("regime bad: 33.33 % of the time" in checked.stdout, checked.stdout)
    predicted = json.loads(done("predict", str(folder / "first.toml"), "--json").stdout)
    require(abs(predicted["up"]["loss"]["share"] - 0.1) < 0.01, predicted["up"]["loss"])


def check_replay(emulator, folder):
    first = [row for row in rows(folder / "first.csv")[1] if row["direction"] == "up"]
    run = Run(emulator, folder, "again", PROFILE, ["--replay", str(folder / "first.csv")])
    check_changes(run)
    run.send(200)
    _, fates, _ = run.finish()
    require([row for row in fates if row["direction"] == "up"] == first[:200], "replayed otherwise")
    other = folder / "other.toml"
    other.write_text(PROFILE.replace('"bad"', '"worse"'), encoding="utf-8")
    done = subprocess.run(
        [emulator, "--listen-a", "127.0.0.1:0", "--listen-b", "127.0.0.1:0", "--profile",
         str(other), "--replay", str(folder / "first.csv"), "--duration", "1ms"],
        capture_output=True, text=True, timeout=20, check=False)
    require(done.returncode == 2 and "the regime 'bad'" in done.stderr, done.stderr)


def check_plain(emulator, folder):
    """Where there are no regimes, nothing speaks of them."""
    run = Run(emulator, folder, "plain", '[up]\ndelay = "5ms"\n')
    run.send(20)
    head, _, statistics = run.finish()
    require("regime" not in head and "regimes" not in statistics["up"], head)


def check_python(emulator, folder):
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "python"))
    os.environ["HAPNET_BIN"] = os.path.dirname(emulator)
    from hapnet.emulator import Emulator  # pylint: disable=import-outside-toplevel
    with Emulator(profile=str(folder / "first.toml"), seed=7) as network:
        require(network.set(regime="bad", up_delay="90ms")["changed"], "set changed nothing")
        shown = network.control.request("show")
        require('delay = "90ms"' in shown["conditions"]["up.regime"], shown["conditions"])
        require(network.apply(profile=shown["profile"])["ok"], "show prints what apply refuses")


def main():
    emulator = os.path.join(os.path.realpath(sys.argv[1]), "hapnet-emulator")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        check_run(emulator, folder)
        check_tools(emulator, folder)
        check_replay(emulator, folder)
        check_plain(emulator, folder)
        check_python(emulator, folder)


main()
