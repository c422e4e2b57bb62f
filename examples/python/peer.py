#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""A peer in Python: side B of task T1, with a scene and an algorithm of its own.

peer.py PORT HOST:PORT OUT.csv, and on the other side hapnet-peer --id 1 --task T1.
"""

import math
import socket
import sys
import time

from hapnet.session import Session, boot_time
from hapnet.wire import Body

TICK, MASS, DRAG, STIFFNESS, DAMPING, FORCE_MAX = 1_000_000, 0.1, 10.0, 500.0, 2.0, 3.3
REACH, WALL = 0.025, 0.0747  # from the centre of the cube to that of a hand; the static cube


def path_x(t):  # the way of the cube in T1 (docs/design/tasks.md), metres
    sines = ((24.0, 0.484, 3.09), (29.0, 0.501, 3.24), (46.7, 0.383, 4.43), (23.2, 0.254, 5.32))
    mm = sum(size * math.sin(2 * math.pi * rate * t + phase) for size, rate, phase in sines)
    swing_in = min(t, 1.0) ** 3 * (10 - 15 * min(t, 1.0) + 6 * min(t, 1.0) ** 2)
    return 1e-3 * swing_in * (22.0 + min(52.7, mm))


class Cube:
    def __init__(self):
        self.x = self.v = self.hip_v = 0.0
        self.hip, self.untouched = 0.1, 0

    def tick(self, dt, t, hands_on, other):  # the algorithm `base`, along x
        falls = path_x(t + 0.01) < path_x(t)  # where the path falls, R pushes
        aim = (path_x(t) + REACH - 0.004 if falls else self.x + REACH + 0.008) if hands_on else 0.1
        step = max(-0.5 * dt, min(0.5 * dt, aim - self.hip))
        self.hip, self.hip_v = self.hip + step, step / dt
        depth = self.x + REACH - self.hip
        push = STIFFNESS * depth + DAMPING * (self.v - self.hip_v) if depth > 0 else 0.0
        force = -max(0.0, min(FORCE_MAX, push))
        theirs = other.contact_force[0] if other and other.touching else 0.0
        theirs = max(-FORCE_MAX, min(FORCE_MAX, theirs))
        self.v += dt * (force + theirs - DRAG * self.v) / (MASS + dt * DRAG)
        self.x += dt * self.v
        if self.x > WALL:
            self.x, self.v = WALL, 0.0
        self.untouched = 0 if force or (other and other.touching) else self.untouched + 1
        follows = self.untouched > 200 or (other and other.touching)
        if not force and follows and other and other.bodies:
            self.x, self.v = other.bodies[0].position[0], other.bodies[0].velocity[0]
        return force


def main(port, remote, out):
    host, _, remote_port = remote.rpartition(":")
    channel = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    channel.bind(("127.0.0.1", int(port)))
    channel.setblocking(False)
    there = (socket.gethostbyname(host), int(remote_port))
    session, cube, wake = Session(2, "T1"), Cube(), boot_time()
    while not session.is_over:
        wake += TICK
        time.sleep(max(0, wake - boot_time()) * 1e-9)
        try:
            while True:
                datagram, sender = channel.recvfrom(2048)
                if sender == there:
                    session.hear(datagram, boot_time())
        except BlockingIOError:
            pass  # nothing more for now
        if hello := session.hello(boot_time()):
            channel.sendto(hello, there)
        if session.start is None or wake < session.start:
            continue
        since = wake - session.start
        if since > session.length_ns:
            break
        force = cube.tick(TICK * 1e-9, since * 1e-9, since < session.length_ns - 3e9, session.heard)
        body = Body(0, (cube.x, 0.0, 0.0), (cube.v, 0.0, 0.0))
        message = session.state(boot_time(), touching=force != 0.0, hip=(cube.hip, 0.0, 0.0),
                                hip_velocity=(cube.hip_v, 0.0, 0.0),
                                contact_force=(force, 0.0, 0.0), bodies=[body])  # fmt: skip
        channel.sendto(message, there)
        print(boot_time(), cube.x, force, sep=",", file=out)
    for _ in range(5):
        channel.sendto(session.bye(), there)
        time.sleep(0.005)
    return 0 if session.states_heard > 0 else 1


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit("usage: peer.py PORT HOST:PORT OUT.csv")
    with open(sys.argv[3], "w", encoding="utf-8") as out:
        print("boottime_ns,x_m,force_n", file=out)
        sys.exit(main(sys.argv[1], sys.argv[2], out))
