# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""hapnet-web as a browser, and as somebody who is none, meets it: docs/formats/live.md."""

import gzip
import json
import os
import re
import shutil
import socket
import subprocess
import tempfile
import time
import unittest

from served import PROGRAM, Live, Server, children_of

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../..")
PAGE_BYTES_MAX = 240_000  # packed: the page, its scripts, styles and modules


class Web(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.server = Server("--stage", "--out", cls.folder.name)
        cls.port, cls.token = cls.server.port, cls.server.token

    @classmethod
    def tearDownClass(cls):
        children = children_of(cls.server.process.pid)
        code = cls.server.stop()
        cls.folder.cleanup()
        deadline = time.monotonic() + 10
        while any(os.path.exists(f"/proc/{child}") for child in children):
            assert time.monotonic() < deadline, "children outlived hapnet-web"
            time.sleep(0.05)
        assert code == 0 and children, (code, children)

    def ask(self, method, path, body=None, **changes):
        return self.server.ask(method, path, body, **changes)

    def wait_for_peers(self, live):
        deadline = time.monotonic() + 30
        while time.monotonic() < deadline:
            frame = live.read()
            if frame["type"] == "frame" and frame["emulator"] and all(frame["peers"]):
                return frame
        self.fail("no frame of both peers within 30 s")

    def test_frames_come_and_a_change_is_answered_with_its_generation(self):
        live = Live(self.port, self.token)
        self.assertEqual((live.status, live.read()["type"]), (101, "hello"))
        self.assertEqual(live.read()["type"], "history")
        self.assertEqual(len(self.wait_for_peers(live)["peers"]), 2)
        status, body = self.ask("POST", "/api/emulator",
                                {"command": "set", "settings": {"both.delay": "40ms"}})
        self.assertEqual(status, 200, body)
        self.assertGreaterEqual(json.loads(body)["generation"], 1)
        live.close()

    def test_one_that_never_reads_blocks_nobody(self):
        idle = Live(self.port, self.token, 4096)
        live = Live(self.port, self.token)
        before = self.wait_for_peers(live)["n"]
        for _ in range(60):
            last = live.read()
        self.assertEqual(self.ask("GET", "/api/state")[0], 200)
        self.assertGreater(last.get("n", before + 1), before)
        live.close()
        idle.close()

    def test_a_wrong_token_closes_the_live_socket(self):
        live = Live(self.port, "0" * len(self.token))
        self.assertEqual(live.read(), 4401)
        live.close()

    def test_nonsense_about_the_hand_closes_the_page_that_sends_it(self):
        for hand in ({"x": 0.3, "y": 0, "z": 0}, {"x": 0, "y": 0}, {"x": "0", "y": 0, "z": 0},
                     [0, 0, 0], {"x": 0, "y": 0, "z": 0, "command": "stop"}, True):
            live = Live(self.port, self.token)
            live.send({"hand": hand})
            got = live.read()
            while isinstance(got, dict):
                got = live.read()
            self.assertEqual(got, 1008, hand)
            live.close()

    def test_the_hand_of_a_simulated_device_moves_for_no_page(self):
        live = Live(self.port, self.token)
        live.send({"hand": {"x": 0, "y": 0, "z": 0}})
        state = json.loads(self.ask("GET", "/api/state")[1])
        self.assertEqual(state["hand"], {"peer": None, "held": False})
        live.close()

    def test_a_page_that_is_late_with_its_token_may_try_again(self):
        live = Live(self.port, None)
        self.assertEqual(live.read(), 4408)
        live.close()

    def test_refuses_each_wrong_header(self):
        mark = {"text": "x"}
        self.assertEqual(self.ask("POST", "/api/mark", mark)[0], 200)
        for status, changes in (
                (403, {"Host": "evil.example"}), (403, {"Host": f"127.evil.com:{self.port}"}),
                (403, {"Origin": "http://evil.example"}), (403, {"Origin": None}),
                (403, {"Origin": "null"}), (403, {"Sec_Fetch_Site": "cross-site"}),
                (401, {"X_Hapnet_Token": None}), (401, {"X_Hapnet_Token": "0" * 32}),
                (415, {"Content_Type": "text/plain"}), (415, {"Content_Type": None}),
                (431, {"X_Large": "x" * 9000})):
            with self.subTest(changes=str(changes)[:60]):
                self.assertEqual(self.ask("POST", "/api/mark", mark, **changes)[0], status)

    def test_refuses_a_large_body_and_paths_out_of_its_table(self):
        self.assertEqual(self.ask("POST", "/api/mark", {"text": "x" * 70000})[0], 413)
        for path in ("/../../etc/passwd", "/a/../../etc/passwd", "/a/%2e%2e/%2e%2e/etc/passwd",
                     "/f/../../etc/passwd", "/f/99999", "/f/-1", "/api/../etc/passwd"):
            with self.subTest(path=path):
                self.assertEqual(self.ask("GET", path)[0], 404)

    def test_says_what_it_does_not_have(self):
        self.assertIsNone(self.server.state()["pace"])
        self.assertEqual(self.ask("POST", "/api/pace", {"do": "play"})[0], 409)

    def test_saves_the_last_seconds_of_all_three(self):
        self.server.wait_for(lambda state: state["keep"]["available"] and len(state["peers"]) == 2
                             and all(peer["state"] == "running" for peer in state["peers"]))
        status, body = self.ask("POST", "/api/keep", {"name": "by-hand", "last": "1s"})
        self.assertEqual(status, 200, body)
        files = sorted(json.loads(body)["files"])
        self.assertEqual(files, ["by-hand-peer-1.rec", "by-hand-peer-2.rec", "by-hand.pcapng"])
        listed = {file["name"]: file
                  for file in json.loads(self.ask("GET", "/api/files")[1])["files"]}
        for name in files:
            file = listed[f"kept/{name}"]
            status, headers, text = self.server.send("GET", file["href"])
            self.assertEqual((status, len(text)), (200, file["bytes"]))
            self.assertIn("attachment", headers["Content-Disposition"])
        self.assertEqual(self.ask("GET", file["href"], X_Hapnet_Token=None)[0], 401)
        self.assertEqual(self.ask("POST", "/api/keep", {"name": "by-hand"})[0], 422, "it is there")
        for name in ("../x", "A", "a b", "", "x" * 41):
            self.assertEqual(self.ask("POST", "/api/keep", {"name": name})[0], 422, name)

    def test_every_answer_forbids_what_a_page_does_not_need(self):
        for path in ("/", "/api/state", "/metrics", "/nowhere"):
            status, headers, _ = self.server.send("GET", path)
            with self.subTest(path=path, status=status):
                self.assertIn("default-src 'none'", headers["Content-Security-Policy"])
                self.assertIn("frame-ancestors 'none'", headers["Content-Security-Policy"])
                self.assertEqual(headers["X-Content-Type-Options"], "nosniff")
                self.assertEqual(headers["Referrer-Policy"], "no-referrer")
                self.assertEqual(headers["Cross-Origin-Resource-Policy"], "same-origin")
                self.assertIsNone(headers["Access-Control-Allow-Origin"])

    def test_nothing_but_a_wanted_file_needs_no_token(self):
        for path in ("/api/state", "/api/history", "/api/files", "/f/0"):
            self.assertEqual(self.ask("GET", path, X_Hapnet_Token=None)[0], 401, path)
        self.assertEqual(self.ask("GET", "/", X_Hapnet_Token=None)[0], 200)
        self.assertNotIn(self.token.encode(), self.ask("GET", "/")[1])

    def test_the_stage_takes_nothing_out_of_its_sets(self):
        for choice in ({"task": "P1; rm"}, {"preset": "/etc/passwd"}, {"algorithm": "./x.so"},
                       {"mode": "real"}, {"device": "omni1394"}, {"peers": 9}):
            status, body = self.ask("POST", "/api/stage", {"do": "restart"} | choice)
            self.assertEqual(status, 400, (choice, body))

    def test_eight_pages_look_and_one_more_is_told(self):
        pages = []
        try:
            for _ in range(8):
                pages.append(Live(self.port, self.token))
                self.assertEqual(pages[-1].read()["type"], "hello")
            pages.append(Live(self.port, self.token))
            self.assertEqual(pages[-1].status, 429)
        finally:
            for page in pages:
                page.close()

    def test_idle_slow_and_malformed_clients_keep_nobody_out(self):
        held = []
        for i in range(60):
            client = socket.create_connection(("127.0.0.1", self.port), timeout=20)
            client.sendall((b"", b"GET /api/st", b"\x16\x03\x01\x02\x00\x01\r\n\r\n")[i % 3])
            held.append(client)
            if i % 10 == 9:
                self.assertEqual(self.ask("GET", "/api/state")[0], 200)
        slow = socket.create_connection(("127.0.0.1", self.port), timeout=20)
        slow.sendall(b"GET / HTTP/1.1\r\nHost: ")
        began = time.monotonic()
        slow.recv(1)
        self.assertLess(time.monotonic() - began, 10, "5 s to send a header")
        for client in held + [slow]:
            client.close()

    def test_live_sockets_without_the_token_count_as_connections(self):
        def descriptors():
            return len(os.listdir(f"/proc/{self.server.process.pid}/fd"))

        before = descriptors()
        held = []
        try:
            for i in range(200):
                held.append(Live(self.port, None if i % 2 else "0" * len(self.token)))
                if i % 20 == 19:
                    self.assertEqual(self.ask("GET", "/api/state")[0], 200)
            self.assertLessEqual(descriptors() - before, 40, "32 connections, and a few under way")
            live = Live(self.port, self.token)  # among them a page with the token gets in
            self.assertEqual((live.status, live.read()["type"]), (101, "hello"))
            live.close()
        finally:
            for one in held:
                one.close()

    def test_the_page_is_small_when_it_is_packed(self):
        index = self.ask("GET", "/")[1]
        known = set(re.findall(r'/a/[0-9a-f]+/[\w./-]+', index.decode()))
        folder = re.match(r"/a/[0-9a-f]+/", sorted(known)[0]).group()
        total, waiting, seen = len(gzip.compress(index)), sorted(known), set()
        while waiting:
            path = waiting.pop()
            if path in seen or path.endswith(".txt"):  # licences are not loaded
                continue
            seen.add(path)
            status, headers, packed = self.server.send("GET", path, Accept_Encoding="gzip")
            if status == 404:
                continue  # a build without modules
            self.assertEqual((status, headers["Content-Encoding"]), (200, "gzip"), path)
            total += len(packed)
            if not path.endswith(".js"):
                continue
            text = gzip.decompress(packed).decode()
            here = path.rsplit("/", 1)[0] + "/"
            for name in re.findall(r'["\'](\.\.?/[\w./-]+\.js)["\']', text):
                waiting.append(os.path.normpath(here + name))
            waiting += [folder + name for name in re.findall(r'["\'](three\.\w+\.min\.js)', text)]
        self.assertGreater(len(seen), 30)
        self.assertLessEqual(total, PAGE_BYTES_MAX)

    def test_metrics_are_text_for_prometheus(self):
        self.server.wait_for(lambda state: state["peers"] and state["emulator"]["attached"])
        status, headers, text = self.server.send("GET", "/metrics", X_Hapnet_Token=None)
        self.assertEqual(status, 200)
        self.assertIn("version=0.0.4", headers["Content-Type"])
        self.assertIn(b"hapnet_emulator_", text)
        promtool = shutil.which("promtool")
        if promtool is None:
            self.skipTest("promtool is not there (Debian package prometheus)")
        done = subprocess.run([promtool, "check", "metrics"], input=text, capture_output=True,
                              timeout=20, check=False)
        self.assertEqual((done.returncode, done.stdout + done.stderr), (0, b""))

    def test_the_dashboard_draws_metrics_that_there_are(self):
        self.server.wait_for(lambda state: len(state["peers"]) == 2 and all(
            one["attached"] for one in [*state["peers"], state["emulator"]]))
        time.sleep(1.1)  # as long as an older text is kept
        text = self.ask("GET", "/metrics", X_Hapnet_Token=None)[1].decode()
        samples = re.findall(r"^(\w+)(?:\{(.*)\})? ", text, re.MULTILINE)
        labels = {}
        for name, found in samples:
            labels.setdefault(name, set()).update(re.findall(r'(\w+)="', found))
        with open(os.path.join(ROOT, "packaging/grafana/hapnet.json"), encoding="utf-8") as file:
            dashboard = json.load(file)
        targets = [target for panel in dashboard["panels"] for target in panel["targets"]]
        self.assertGreater(len(targets), 5)
        for target in targets:
            names = re.findall(r"\bhapnet_\w+", target["expr"])
            self.assertTrue(names, target)
            for name in names:
                self.assertIn(name, labels)
                wanted = re.findall(r"\{\{\s*(\w+)\s*\}\}", target.get("legendFormat", ""))
                # A path is named only if there are several.
                self.assertLessEqual(set(wanted) - {"path", "instance"}, labels[name], target)

    def test_a_chosen_port_that_is_taken_ends_it_with_3(self):
        done = subprocess.run([PROGRAM, "--port", str(self.port)], capture_output=True,
                              timeout=20, check=False)
        self.assertEqual(done.returncode, 3, done.stderr)


if __name__ == "__main__":
    unittest.main()
