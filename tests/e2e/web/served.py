# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""A running hapnet-web, and its clients by hand: one that asks, and a WebSocket."""

import base64
import http.client
import json
import os
import signal
import socket
import struct
import subprocess
import time

BIN = os.environ["HAPNET_BIN"]
PROGRAM = os.path.join(BIN, "hapnet-web")


def children_of(pid):
    """Of all its threads: the stage starts them in one of its own."""
    found = []
    for thread in os.listdir(f"/proc/{pid}/task"):
        with open(f"/proc/{pid}/task/{thread}/children", encoding="ascii") as file:
            found += [int(word) for word in file.read().split()]
    return found


def is_alive(pid):
    """Whether it runs; a zombie does not."""
    try:
        with open(f"/proc/{pid}/stat", encoding="ascii", errors="replace") as file:
            return file.read().rsplit(") ", 1)[1][0] != "Z"
    except FileNotFoundError:
        return False


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
        if token is not None:
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
        while kind & 15 == 9:  # a ping keeps an idle socket alive
            self.socket.sendall(bytes([0x8A, 0x80]) + bytes(4))
            kind, body = self.read_fragment()
        if kind & 15 == 8:
            return struct.unpack(">H", body[:2])[0]
        while not kind & 0x80:
            kind, more = self.read_fragment()
            body += more
        self.text = body.decode()  # the newest message, as received
        message = json.loads(self.text)
        if message["type"] == "frame":
            self.send({"ack": message["n"]})
        return message

    def close(self):
        self.file.close()
        self.socket.close()


class Server:
    """hapnet-web with these arguments, at a port of its own."""

    def __init__(self, *arguments, host="127.0.0.1"):
        port = [] if "--port" in arguments else ["--port", "0"]
        self.process = subprocess.Popen([PROGRAM, *port, *arguments], stdout=subprocess.PIPE,
                                        text=True)
        url = self.process.stdout.readline().split()[1]
        self.port = int(url.split(":")[2].split("/")[0])
        self.token = url.split("#t=")[1]
        self.own = f"http://{host}:{self.port}"
        self.host = host

    def stop(self, how=signal.SIGTERM):
        """Ends it; the exit code."""
        self.process.send_signal(how)
        code = self.process.wait(timeout=20)
        self.process.stdout.close()
        return code

    def send(self, method, path, body=None, **changes):
        """The whole reply: status, headers, bytes."""
        headers = {"Host": f"{self.host}:{self.port}", "X-Hapnet-Token": self.token}
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
        found = reply.status, reply.headers, reply.read()
        client.close()
        return found

    def ask(self, method, path, body=None, **changes):
        """Status and bytes."""
        status, _, text = self.send(method, path, body, **changes)
        return status, text

    def state(self):
        return json.loads(self.ask("GET", "/api/state")[1])

    def wait_for(self, condition, seconds=30):
        """The state once that holds of it."""
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline:
            state = self.state()
            if condition(state):
                return state
            time.sleep(0.05)
        raise AssertionError(f"it does not hold within {seconds} s: {json.dumps(state)[:2000]}")
