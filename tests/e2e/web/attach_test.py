# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""hapnet-web beside daemons that run already, in virtual time, elsewhere than on loopback, and
with more than two peers."""

import csv
import json
import os
import signal
import stat
import subprocess
import tempfile
import time
import unittest

from hapnet import Emulator, Lab, Peer
from served import BIN, PROGRAM, Live, Server, children_of, is_alive


def program(name):
    return os.path.join(BIN, name)


class Daemons:
    """An emulator and two peers with simulated hands, that nobody else has started."""

    def __init__(self, folder, seconds, *more):
        self.records = [f"{folder}/peer-{i}.rec" for i in (1, 2)]
        self.emulator = Emulator(delay="20ms", options=more).start()
        self.peers = [
            Peer(id=i + 1, remote=self.emulator.ready[side], duration=f"{seconds}s",
                 record=self.records[i], options=more).start() for i, side in enumerate("ab")]

    def arguments(self):
        return ["--emulator", self.emulator.control_path, "--peer", self.peers[0].control_path,
                "--peer", self.peers[1].control_path]

    def finish(self):
        for peer in self.peers:
            peer.join(40)
        self.emulator.stop()

    def stop(self):
        for daemon in [*self.peers, self.emulator]:
            daemon.kill()


class Attach(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def serve(self, *arguments, **more):
        server = Server(*arguments, **more)
        self.addCleanup(lambda: server.process.poll() is None and server.stop())
        return server

    def test_shows_daemons_that_run_and_killing_it_changes_nothing_for_them(self):
        daemons = Daemons(self.folder, 8)
        self.addCleanup(daemons.stop)
        server = self.serve(*daemons.arguments())
        state = server.wait_for(lambda now: len(now["peers"]) == 2 and now["emulator"]["attached"]
                                and all(peer["state"] == "running" for peer in now["peers"]))
        self.assertEqual([peer["letter"] for peer in state["peers"]], ["A", "B"])
        self.assertFalse(state["stage"]["available"])
        self.assertFalse(state["keep"]["available"], "they hold nothing")
        self.assertIn("--keep", state["keep"]["says"])
        self.assertEqual(server.ask("POST", "/api/keep", {})[0], 409)
        self.assertEqual(server.ask("POST", "/api/stage", {"do": "start"})[0], 409)
        status, body = server.ask("POST", "/api/emulator",
                                  {"command": "set", "settings": {"both.delay": "30ms"}})
        self.assertEqual((status, json.loads(body)["generation"]), (200, 2))
        for file in ("/etc/passwd", "/nowhere/at/all"):
            status, body = server.ask("POST", "/api/emulator", {
                "command": "apply",
                "profile": f'up.delay = {{ law = "trace", file = "{file}" }}'})
            self.assertEqual(status, 422)
            self.assertIn(f"does not bring the file '{file}'", json.loads(body)["error"])
        self.assertEqual(server.ask("POST", "/api/emulator", {
            "command": "apply", "profile": "", "files": {"a": "1"}})[0], 400)
        self.assertEqual(server.stop(signal.SIGKILL), -signal.SIGKILL)
        again = self.serve(*daemons.arguments())
        again.wait_for(lambda now: now["emulator"]["conditions"]
                       and now["emulator"]["conditions"]["up.delay"] == "30ms")
        again.stop(signal.SIGKILL)
        daemons.finish()
        analysis = Lab().analyse(*daemons.records)
        # A gap at the kill would be longer than a second.
        for side in ("a", "b"):
            self.assertGreater(analysis[side]["tick"]["rate_hz"], 900)
        for way in ("a_to_b", "b_to_a"):
            self.assertEqual(analysis[way]["loss"], 0)

    def test_saves_by_daemons_of_others_and_sees_them_go_and_come(self):
        kept = f"{self.folder}/kept"
        os.mkdir(kept)
        daemons = Daemons(self.folder, 6, "--keep", "5s", "--keep-in", kept)
        self.addCleanup(daemons.stop)
        server = self.serve(*daemons.arguments())
        server.wait_for(lambda now: now["keep"]["available"] and len(now["peers"]) == 2
                        and all(peer["state"] == "running" for peer in now["peers"]))
        time.sleep(1)
        status, body = server.ask("POST", "/api/keep", {"name": "other", "last": "1s"})
        self.assertEqual(status, 200, body)
        self.assertEqual(sorted(os.listdir(kept)),
                         ["other-peer-1.rec", "other-peer-2.rec", "other.pcapng"])
        self.assertEqual(json.loads(server.ask("GET", "/api/files")[1])["files"], [],
                         "files of others are theirs")
        self.assertEqual(server.ask("POST", "/api/keep", {"last": "6s"})[0], 422, "5 s are held")
        daemons.finish()
        gone = server.wait_for(lambda now: not now["emulator"]["attached"])
        self.assertIn("start hapnet-emulator", gone["help"])
        self.assertEqual(server.ask("POST", "/api/emulator", {"command": "show"})[0], 503)

    def test_listens_elsewhere_by_name_and_with_a_token_of_ones_own(self):
        token = f"{self.folder}/token"
        with open(token, "w", encoding="ascii") as file:
            file.write("0123456789abcdef0123456789abcdef\n")
        url = f"{self.folder}/url"
        refused = subprocess.run([PROGRAM, "--token-file", token, "--port", "0"],
                                 capture_output=True, timeout=20, check=False)
        self.assertEqual(refused.returncode, 2, "others may read it")
        os.chmod(token, 0o600)
        for missing in (["--token-file", token], ["--host", "lab.example"], []):
            done = subprocess.run([PROGRAM, "--listen", "127.0.0.2", *missing],
                                  capture_output=True, timeout=20, check=False)
            self.assertEqual(done.returncode, 2)
        port = 18461
        server = self.serve("--listen", "127.0.0.2", "--host", "lab.example", "--token-file", token,
                            "--url-file", url, "--port", str(port))
        self.assertEqual(server.token, "0123456789abcdef0123456789abcdef")
        self.assertEqual(stat.S_IMODE(os.stat(url).st_mode), 0o600)
        self.assertEqual(server.ask("GET", "/", Host=f"lab.example:{port}")[0], 200)
        self.assertEqual(server.ask("POST", "/api/mark", {"text": "x"}, Host=f"lab.example:{port}",
                                    Origin=f"http://lab.example:{port}")[0], 200)
        self.assertEqual(server.ask("GET", "/", Host=f"other.example:{port}")[0], 403)

    def test_nothing_attached_says_what_to_run(self):
        server = self.serve()
        self.assertIn("--stage", server.state()["help"])
        self.assertEqual(server.ask("POST", "/api/keep", {})[0], 409)

    def test_ends_cleanly_while_pages_look(self):
        server = self.serve()
        pages = [Live(server.port, server.token) for _ in range(8)]
        for page in pages:
            self.assertEqual(page.read()["type"], "hello")
        self.assertEqual(server.stop(), 0)
        for page in pages:
            page.close()

    def test_a_stage_of_three_has_a_link_for_every_two(self):
        server = self.serve("--stage", "--stopped", "--out", self.folder)
        status, body = server.ask("POST", "/api/stage",
                                  {"do": "start", "task": "T7", "peers": 3, "preset": "lan"})
        self.assertEqual(status, 200, body)
        state = server.wait_for(lambda now: len(now["peers"]) == 3
                                and all(peer["state"] == "running" for peer in now["peers"]))
        self.assertEqual([peer["letter"] for peer in state["peers"]], ["A", "B", "C"])
        self.assertEqual(state["emulator"]["paths"], ["1-2", "1-3", "2-3"])
        status, body = server.ask("POST", "/api/emulator",
                                  {"command": "set", "settings": {"1-3.delay": "70ms"}})
        self.assertEqual(status, 200, body)
        server.wait_for(
            lambda now: now["emulator"]["conditions"].get("1-3.delay") == "70ms"
            and now["emulator"]["conditions"].get("1-2.delay") != "70ms")
        live = Live(server.port, server.token)
        while (frame := live.read())["type"] != "frame" or not all(frame["peers"]):
            pass
        self.assertEqual([(pair["a"], pair["b"]) for pair in frame["pairs"]],
                         [(1, 2), (1, 3), (2, 3)])
        live.close()

    def test_what_it_has_started_ends_when_it_is_killed(self):
        server = self.serve("--stage", "--out", self.folder)
        server.wait_for(lambda now: len(now["peers"]) == 2
                        and all(peer["state"] == "running" for peer in now["peers"]))
        started = children_of(server.process.pid)
        self.assertEqual(len(started), 3)
        server.stop(signal.SIGKILL)
        deadline = time.monotonic() + 20
        while any(is_alive(process) for process in started):
            self.assertLess(time.monotonic(), deadline, "a program outlives hapnet-web")
            time.sleep(0.05)

    def test_virtual_time_of_a_lab_is_sought_and_gives_equal_numbers(self):
        control = f"{self.folder}/lab.sock"
        lab = subprocess.Popen([program("hapnet-lab"), "play", "--delay", "160ms", "--control",
                                control, "--out", self.folder, "--pace", "paused"],
                               stdout=subprocess.PIPE, text=True)
        self.addCleanup(lambda: (lab.terminate(), lab.wait(timeout=20), lab.stdout.close()))
        self.assertIn("ready", lab.stdout.readline())
        server = self.serve("--lab", control)
        server.wait_for(lambda now: now["mode"] == "virtual" and len(now["peers"]) == 2
                        and all(peer["attached"] for peer in now["peers"]))

        def pace(**request):
            status, body = server.ask("POST", "/api/pace", request)
            self.assertEqual(status, 200, body)
            return json.loads(body)["pace"]

        first = pace(do="seek", to_s=10)
        pace(do="seek", to_s=3)
        second = pace(do="seek", to_s=10)
        self.assertEqual((first["at_s"], first["digest"]), (10.0, second["digest"]))
        self.assertEqual(server.ask("POST", "/api/pace", {"do": "seek", "to_s": "x"})[0], 422)
        self.assertEqual(server.ask("POST", "/api/pace", {"do": "show", "command": "stop"})[0], 400)
        self.assertEqual(server.ask("POST", "/api/keep", {})[0], 409)
        status, body = server.ask("POST", "/api/emulator",
                                  {"command": "set", "settings": {"both.delay": "80ms"}})
        self.assertEqual(status, 200, body)
        self.assertEqual(pace(do="seek", to_s=12)["steps"][0]["settings"]["up.delay"], "80ms")
        status, body = server.ask("POST", "/api/pace", {"do": "save"})
        self.assertEqual((status, json.loads(body)["file"]), (200, "experiment-1.toml"))

    def test_records_are_sought_and_show_what_was_recorded(self):
        daemons = Daemons(self.folder, 6)
        self.addCleanup(daemons.stop)
        daemons.finish()
        control = f"{self.folder}/lab.sock"
        lab = subprocess.Popen([program("hapnet-lab"), "play", *daemons.records, "--control",
                                control, "--pace", "paused"], stdout=subprocess.PIPE, text=True)
        self.addCleanup(lambda: (lab.terminate(), lab.wait(timeout=20), lab.stdout.close()))
        self.assertIn("ready", lab.stdout.readline())
        server = self.serve("--lab", control)
        state = server.wait_for(lambda now: len(now["peers"]) == 2 and now["scenes"]
                                and all(peer["attached"] for peer in now["peers"]))
        self.assertEqual((state["mode"], state["pace"]["read_only"]), ("virtual", True))
        self.assertGreater(state["pace"]["length_s"], 5)

        def pace(**request):
            status, body = server.ask("POST", "/api/pace", request)
            self.assertEqual(status, 200, body)
            return json.loads(body)["pace"]

        live = Live(server.port, server.token)
        self.addCleanup(live.close)

        before = state["pace"]["length_s"] - 6  # the session starts

        def seek(to_s):
            pace(do="seek", to_s=to_s)
            while True:
                frame = live.read()
                if frame["type"] == "frame" and frame["at_s"] == to_s and all(
                        peer and abs(peer["session"]["at_s"] + before - to_s) < 0.01
                        for peer in frame["peers"]):
                    return frame

        first = seek(3)
        seek(1)
        second = seek(3)
        told = [[(peer["tick"], peer["cube"], peer["session"]) for peer in frame["peers"]]
                for frame in (first, second)]
        self.assertEqual(told[0], told[1])
        done = subprocess.run([program("hapnet-lab"), "export", daemons.records[0], "--csv"],
                              capture_output=True, text=True, check=True)
        rows = list(csv.DictReader(done.stdout.splitlines()))
        row = next(row for row in rows if int(row["tick"]) == first["peers"][0]["tick"])
        cube_mm = 1e3 * first["peers"][0]["cube"][0]
        self.assertAlmostEqual(float(row["cube_x_mm"]), cube_mm, places=3)
        self.assertEqual(server.ask("POST", "/api/emulator",
                                    {"command": "set", "settings": {"both.delay": "1ms"}})[0], 422)
        self.assertEqual(server.ask("POST", "/api/pace", {"do": "save"})[0], 422)
        self.assertEqual(server.ask("POST", "/api/keep", {})[0], 409)
        pace(do="factor", factor=1)
        pace(do="play")
        while (frame := live.read())["type"] != "frame" or frame["pairs"][0]["apart_mm"] is None:
            pass
        self.assertLess(frame["pairs"][0]["apart_mm"], 20)
        pace(do="factor", factor="max")
        pace(do="play")
        server.wait_for(lambda now: now["pace"]["state"] == "ended")


if __name__ == "__main__":
    unittest.main()
