# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""hapnet-web as a browser, and as somebody who is none, meets it: docs/formats/live.md."""

import base64
import http.client
import json
import os
import signal
import socket
import struct
import subprocess
import tempfile
import time
import unittest

PROGRAM = os.path.join(os.environ["HAPNET_BIN"], "hapnet-web")


def children_of(pid):
    """Of all its threads: the stage starts them in one of its own."""
    found = []
    for thread in os.listdir(f"/proc/{pid}/task"):
        with open(f"/proc/{pid}/task/{thread}/children", encoding="ascii") as file:
            found += [int(word) for word in file.read().split()]
    return found


class Live:
    """A WebSocket at /live, by hand."""

    def __init__(self, port, token, receive_buffer=None):
        self.socket = socket.socket()
        if receive_buffer:
            self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_buffer)
        self.socket.settimeout(20)
        self.socket.connect(("127.0.0.1", port))
        self.socket.sendall((
            f"GET /live HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\n"
            "Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: "
            f"{base64.b64encode(os.urandom(16)).decode()}\r\n"
            f"Origin: http://127.0.0.1:{port}\r\n\r\n").encode())
        self.file = self.socket.makefile("rb")
        self.status = int(self.file.readline().split()[1])
        while self.file.readline() not in (b"\r\n", b""):
            pass
        self.send({"token": token})

    def send(self, message):
        text = json.dumps(message).encode()
        mask = os.urandom(4)
        masked = bytes(byte ^ mask[i % 4] for i, byte in enumerate(text))
        self.socket.sendall(bytes([0x81, 0x80 | len(text)]) + mask + masked)

    def read_fragment(self):
        kind, size = self.file.read(2)
        if size == 126:
            size = struct.unpack(">H", self.file.read(2))[0]
        elif size == 127:
            size = struct.unpack(">Q", self.file.read(8))[0]
        return kind, self.file.read(size)

    def read(self):
        """A message, or the code with which the server closes."""
        kind, body = self.read_fragment()
        if kind & 15 == 8:
            return struct.unpack(">H", body[:2])[0]
        while not kind & 0x80:
            kind, more = self.read_fragment()
            body += more
        message = json.loads(body)
        if message["type"] == "frame":
            self.send({"ack": message["n"]})
        return message

    def close(self):
        self.file.close()
        self.socket.close()


class Web(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.server = subprocess.Popen(
            [PROGRAM, "--stage", "--out", cls.folder.name, "--port", "0"],
            stdout=subprocess.PIPE, text=True)
        url = cls.server.stdout.readline().split()[1]
        cls.port = int(url.split(":")[2].split("/")[0])
        cls.token = url.split("#t=")[1]
        cls.own = f"http://127.0.0.1:{cls.port}"

    @classmethod
    def tearDownClass(cls):
        children = children_of(cls.server.pid)
        cls.server.send_signal(signal.SIGTERM)
        code = cls.server.wait(timeout=20)
        cls.server.stdout.close()
        cls.folder.cleanup()
        deadline = time.monotonic() + 10
        while any(os.path.exists(f"/proc/{child}") for child in children):
            assert time.monotonic() < deadline, "children outlived hapnet-web"
            time.sleep(0.05)
        assert code == 0 and children, (code, children)

    def ask(self, method, path, body=None, **changes):
        headers = {"Host": f"127.0.0.1:{self.port}", "X-Hapnet-Token": self.token}
        if method == "POST":
            headers |= {"Origin": self.own, "Content-Type": "application/json"}
        for name, value in changes.items():
            headers[name.replace("_", "-")] = value
        client = http.client.HTTPConnection("127.0.0.1", self.port, timeout=20)
        client.putrequest(method, path, skip_host=True, skip_accept_encoding=True)
        for name, value in headers.items():
            if value is not None:
                client.putheader(name, value)
        text = b"" if body is None else json.dumps(body).encode()
        client.putheader("Content-Length", str(len(text)))
        client.endheaders()
        try:
            client.send(text)
        except (BrokenPipeError, ConnectionResetError):
            pass  # refused by its length
        reply = client.getresponse()
        found = reply.status, reply.read()
        client.close()
        return found

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
        state = json.loads(self.ask("GET", "/api/state")[1])
        self.assertFalse(state["trap"]["available"])
        self.assertFalse(state["keep"]["available"])
        self.assertIsNone(state["pace"])
        self.assertEqual(self.ask("POST", "/api/keep", {})[0], 409)
        self.assertEqual(self.ask("POST", "/api/pace", {"do": "play"})[0], 409)

    def test_a_chosen_port_that_is_taken_ends_it_with_3(self):
        done = subprocess.run([PROGRAM, "--port", str(self.port)], capture_output=True,
                              timeout=20, check=False)
        self.assertEqual(done.returncode, 3, done.stderr)


if __name__ == "__main__":
    unittest.main()
