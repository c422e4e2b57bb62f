#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""One of several commands on a network, which all run this with their own letter.

network.py streams LETTER COUNT   a stream of TCP to each later command and back, each way whole
network.py groups LETTER COUNT   A asks a group of IPv4, all hosts, and a group of IPv6 who is there

A ends when all is done, and prints who has answered.
"""

import hashlib
import os
import random
import socket
import struct
import sys
import threading

PATIENCE = 20.0
STREAM_PORT, DONE_PORT, GROUP_PORT = 7300, 7301, 7400
GROUP, GROUP_V6 = "239.255.0.7", "ff02::7"


def address(letter):
    return os.environ[f"HAPNET_{letter.upper()}"]


def connected(letter, port):
    """The others may begin later."""
    for _ in range(400):
        try:
            return socket.create_connection((address(letter), port), PATIENCE)
        except ConnectionRefusedError:
            threading.Event().wait(0.05)
    raise TimeoutError(f"no connection to {letter}")


def echo(server):
    while True:
        client, _ = server.accept()
        threading.Thread(target=echo_one, args=(client,), daemon=True).start()


def echo_one(client):
    while part := client.recv(65536):
        client.sendall(part)
    client.shutdown(socket.SHUT_WR)


def stream_to(letter):
    """What comes back is what was sent."""
    sent = random.Random(letter).randbytes(300_000)
    with connected(letter, STREAM_PORT) as stream:
        writer = threading.Thread(target=lambda: (stream.sendall(sent),
                                                  stream.shutdown(socket.SHUT_WR)))
        writer.start()
        back = b""
        while part := stream.recv(65536):
            back += part
        writer.join()
    assert hashlib.sha256(back).digest() == hashlib.sha256(sent).digest(), f"not whole: {letter}"


def streams(letter, letters):
    server = socket.create_server(("", STREAM_PORT))
    threading.Thread(target=echo, args=(server,), daemon=True).start()
    done = socket.create_server(("", DONE_PORT)) if letter == "a" else None
    for other in letters[letters.index(letter) + 1:]:
        stream_to(other)
    if done is None:
        with connected("a", DONE_PORT) as say:
            say.sendall(letter.encode())
        threading.Event().wait()
    done.settimeout(PATIENCE)
    heard = {"a"}
    while len(heard) < len(letters):
        client, _ = done.accept()
        heard.add(client.recv(1).decode())
    print("streams", " ".join(sorted(heard)))


def group_socket(family):
    """A member of the group, whose answers say its letter."""
    end = socket.socket(family, socket.SOCK_DGRAM)
    if family == socket.AF_INET:
        end.bind(("", GROUP_PORT))
        member = socket.inet_aton(GROUP) + socket.inet_aton("0.0.0.0")
        end.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, member)
    else:
        end.setsockopt(socket.IPPROTO_IPV6, socket.IPV6_V6ONLY, 1)
        end.bind(("", GROUP_PORT))
        member = socket.inet_pton(family, GROUP_V6) + struct.pack("I", index())
        end.setsockopt(socket.IPPROTO_IPV6, socket.IPV6_JOIN_GROUP, member)
    return end


def index():
    return socket.if_nametoindex("eth0")


def answer(end, letter):
    while True:
        _, asker = end.recvfrom(100)
        end.sendto(letter.encode(), asker)


def who_answers(family, to, others):
    """The letters that answer, of those that are expected; asked again, as they may begin later."""
    with socket.socket(family, socket.SOCK_DGRAM) as end:
        end.setsockopt(socket.SOL_SOCKET, socket.SO_BROADCAST, 1)
        end.settimeout(0.2)
        heard = set()
        for _ in range(int(PATIENCE / 0.2)):
            end.sendto(b"who", to)
            try:
                while heard != others:
                    heard.add(end.recv(100).decode())
            except TimeoutError:
                continue
            break
    return " ".join(sorted(heard))


def groups(letter, letters):
    if letter != "a":
        for family in (socket.AF_INET, socket.AF_INET6):
            threading.Thread(target=answer, args=(group_socket(family), letter)).start()
        threading.Event().wait()
    others = set(letters) - {"a"}
    for name, family, to in (
            ("group", socket.AF_INET, (GROUP, GROUP_PORT)),
            ("all", socket.AF_INET, ("255.255.255.255", GROUP_PORT)),
            ("net", socket.AF_INET, ("10.0.0.255", GROUP_PORT)),
            ("group6", socket.AF_INET6, (GROUP_V6, GROUP_PORT, 0, index()))):
        print(name, who_answers(family, to, others))


def main(what, letter, count):
    letters = "abcdefgh"[:int(count)]
    {"streams": streams, "groups": groups}[what](letter, letters)


main(*sys.argv[1:])
