#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""remote-proxy once more, in one dimension, after docs/design/remote-proxy.md.

Two copies of the paper's scene, two simulated hands (docs/design/tasks.md) and a network between
them that only delays, in plain Python: to see whether the page says all that is needed to build the
algorithm. Its numbers are compared with those of the lab.

    tests/reference/remote_proxy.py --seeds 10                     the means of this program
    tests/reference/remote_proxy.py --lab build/release/bin/hapnet-lab --seeds 10
                                      beside the lab's; exits with 1 where they differ by over 5 %

Whoever wrote it had seen the C++ of the algorithm, and started from the page all the same; what was
missing there was added to the page. The hands, the device and the scene were written from
device/simulated/ and the scene's file: they are not what is tried here.
"""
import argparse
import csv
import math
import pathlib
import random
import subprocess
import sys
import tempfile

TICK = 1e-3
RUNNING_S = 27.0

# --- the scene: scripts/scenes/paper.toml ---------------------------------------------------------
MASS, DRAG = 0.1, 10.0
CONTACT_K, CONTACT_C, FORCE_MAX = 500.0, 2.0, 3.3
FACE = 0.025  # from the cube's centre to a HIP that touches it
STOP = 0.0747  # the cube's centre when the static cube stops it
WORLD_STEPS = 5


class World:
    """A cube on the platform along x, and hands on its faces: (side, place, velocity)."""

    def __init__(self):
        self.x = self.v = 0.0

    def tick(self, hands):
        """Mean force of each hand on the cube in the tick."""
        dt = TICK / WORLD_STEPS
        sums = [0.0] * len(hands)
        for step in range(WORLD_STEPS):
            total = 0.0
            for i, hand in enumerate(hands):
                if hand is None:
                    continue
                side, place, speed = hand
                depth = FACE - side * (place + speed * step * dt - self.x)
                if depth <= 0.0:
                    continue
                force = CONTACT_K * depth - CONTACT_C * side * (speed - self.v)
                force = -side * min(max(force, 0.0), FORCE_MAX)
                sums[i] += force
                total += force
            self.v = (self.v + dt * total / MASS) / (1.0 + dt * DRAG / MASS)
            self.x += dt * self.v
            if self.x > STOP:
                self.x, self.v = STOP, min(self.v, 0.0)
        return [force / WORLD_STEPS for force in sums]


# --- the hands and their tasks: docs/design/tasks.md ---
def smooth(u):
    u = min(max(u, 0.0), 1.0)
    return u * u * u * (10.0 + u * (6.0 * u - 15.0))


def path(t):
    t = max(t, 0.0)
    turns = 2.0 * math.pi * t
    swings = (24.0 * math.sin(0.484 * turns + 3.09) + 29.0 * math.sin(0.501 * turns + 3.24)
              + 46.7 * math.sin(0.383 * turns + 4.43) + 23.2 * math.sin(0.254 * turns + 5.32))
    return smooth(t) * 1e-3 * (22.0 + min(52.7, swings))


PRESSES = ((2.0, 8.0, -1, 0.5), (8.0, 12.0, -1, 1.0), (12.0, 14.0, -1, 2.0),
           (14.75, 20.75, 1, 0.5), (20.75, 24.75, 1, 1.0), (24.75, 26.75, 1, 2.0))


def closing(depth, t):
    return (-0.008 + 0.007 * smooth(t / 0.5) + (0.001 + depth) * smooth((t - 0.5) / 1.5))


def aim(task, side, t):
    if task == "T1":
        speed = (path(t + 0.005) - path(t - 0.005)) / 0.01
        rising = min(max(0.5 + speed / 0.040, 0.0), 1.0)
        turn = rising if side < 0 else 1.0 - rising
        return path(t) + side * (FACE + 0.008 * (1.0 - turn))
    if task == "T2":
        depth = closing(0.004, t)
        for begin, end, presses, hertz in PRESSES:
            if presses == side and begin <= t < end:
                depth += 0.0035 * math.sin(2.0 * math.pi * hertz * (t - begin))
        return side * (FACE - depth)
    lag = 0.0 if side < 0 else 0.060
    depth = 4.0 / 7.0 * (1.0 / Hand.STIFFNESS + 1.0 / CONTACT_K)
    return path(0.5 * (t - lag)) + side * (FACE - depth)


class Hand:
    """A nominal hand on a simulated Omni."""

    MASS, DAMPING, STIFFNESS, FRICTION = 0.20, 5.0, 200.0, 0.26
    COUNT = 55e-6
    STEPS = 4

    def __init__(self, task, side, draw):
        self.task, self.side = task, side
        self.swings = []
        for amplitude, least, most in ((2e-3 / 3, 0.3, 0.9), (1e-4 / 3, 8.0, 12.0)):
            for _ in range(3):
                self.swings.append((amplitude, draw.uniform(least, most), draw.random()))
        self.place = self.target = side * 0.055
        self.speed = 0.0
        self.reported, self.velocity = self.place, 0.0
        self.share = 1.0 - math.exp(-2.0 * math.pi * 30.0 * TICK)
        self.move(0.0, 0.0, 0)

    def intention(self, t):
        target = aim(self.task, self.side, t)
        return target + sum(a * math.sin(2.0 * math.pi * (f * t + p)) for a, f, p in self.swings)

    def move(self, t, force, steps=STEPS):
        target = self.intention(t)
        if steps:
            dt = TICK / steps
            way = (target - self.target) / steps
        for step in range(steps):
            pull = force + self.STIFFNESS * (self.target + (step + 0.5) * way - self.place)
            self.place, self.speed = slide(self.place, self.speed, pull, dt, self.MASS,
                                           self.DAMPING, self.FRICTION)
        self.target = target
        if not steps:
            self.place = target
        reported = round(self.place / self.COUNT) * self.COUNT
        if steps:
            self.velocity += self.share * ((reported - self.reported) / TICK - self.velocity)
        self.reported = reported


def slide(place, speed, force, dt, mass, damping, friction):
    """A short time of a mass under a constant force with damping and Coulomb friction (Karnopp)."""
    if speed == 0.0 and abs(force) <= friction:
        return place, 0.0
    along = math.copysign(1.0, speed if speed != 0.0 else force)
    after = (speed + dt * (force - along * friction) / mass) / (1.0 + damping * dt / mass)
    if after * along < 0.0:
        after = 0.0
    return place + dt * after, after


# --- the algorithm: docs/design/remote-proxy.md ---
MODEL_M, MODEL_B, MODEL_K, FRICTION = 0.22, 7.0, 300.0, 0.26  # the friction is that of the device


class Intention:
    """What is sent."""

    def __init__(self):
        self.known = False

    def add(self, h, v, force):
        raw = h + (MODEL_B * v - force) / MODEL_K
        if not self.known:
            self.known = True
            self.vs, self.rs, self.r, self.slope = v, raw, raw, 0.0
            return
        self.vs += (v - self.vs) * (1.0 - math.exp(-TICK / 0.015))
        reach = FRICTION / MODEL_K
        if abs(self.vs) > 0.004:
            self.rs = raw + math.copysign(reach, self.vs)
        else:
            self.rs = min(max(self.rs, raw - reach), raw + reach)
        theta = math.exp(-TICK / 0.020)
        rest = self.rs - (self.r + self.slope * TICK)
        self.r += self.slope * TICK + (1.0 - theta * theta) * rest
        self.slope += (1.0 - theta) ** 2 / TICK * rest


class Message:
    __slots__ = ("n", "touching", "h", "r", "slope", "work", "force", "x", "v")


class Proxy:
    """The other hand in this copy."""

    def __init__(self):
        self.words = []
        self.older = 0
        self.here = False
        self.last = None
        self.eta, self.g = 0.0, 1.0
        self.uy = self.uu = self.yy = 0.0
        self.velocity = 0.0
        self.age_max = 0.0
        self.touched = None

    def hear(self, m, age):
        """The work of its owner since the message before."""
        first = self.last is None
        filter_s = max(0.020, 0.15 * age)
        passed = 0 if first else m.n - self.last.n
        share = 1.0 if first else 1.0 - math.exp(-passed * TICK / filter_s)
        self.velocity += share * (m.slope - self.velocity)
        if m.touching:
            self.touched = m.n
        self.words.append((m.n, m.r, self.velocity))
        if not first:
            self.learn(m, passed, age)
        work = 0.0 if first else m.work - self.last.work
        self.last = m
        return work

    def learn(self, m, passed, age):
        wanted = m.n - round(age / TICK)
        while self.older + 1 < len(self.words) and self.words[self.older + 1][0] <= wanted:
            self.older += 1
        n, r, velocity = self.words[self.older]
        if n > wanted:
            return
        u = (m.n - n) * TICK * velocity
        y = m.r - r
        share = 1.0 - math.exp(-passed * TICK / 2.0)
        self.uy += share * (u * y - self.uy)
        self.uu += share * (u * u - self.uu)
        self.yy += share * (y * y - self.yy)
        scale = self.uu + (0.015 * age) ** 2
        self.eta = min(max(self.uy / scale, 0.0), 1.0) if scale > 0.0 else 0.0

    def look(self, world, age, own_touches):
        self.age_max = max(self.age_max * (1.0 - TICK / 5.0), min(age, 0.4))
        m = self.last
        if m is None or not m.touching:
            self.here = False
            return
        if not self.here:
            self.here = True
            self.g = 1.0
            self.place, self.speed = world.x + (m.h - m.x), world.v
            self.anchor = self.place + (m.r - m.h)
        wanted = m.r + self.eta * min(age, 0.25) * self.velocity
        way = self.eta * self.velocity * TICK if age < 0.25 else 0.0
        way += (1.0 - math.exp(-TICK / 0.020)) * (wanted - self.anchor - way)
        self.anchor += min(max(way, -0.4 * TICK), 0.4 * TICK)
        trusted = 1.0
        if own_touches:
            missed = self.yy - 2.0 * self.eta * self.uy + self.eta ** 2 * self.uu
            trusted = 1.0 / (1.0 + missed / 0.003 ** 2 + self.uu / 0.005 ** 2)
        self.g += TICK / 0.05 * (trusted - self.g)

    def motion_j(self):
        return 0.5 * MODEL_M * self.speed ** 2 if self.here else 0.0

    def springs_j(self):
        if not self.here:
            return 0.0
        stretch = self.anchor - self.place
        force = self.last.force
        return 0.5 * (self.g * MODEL_K * stretch ** 2 + (1.0 - self.g) * force ** 2 / MODEL_K)

    def step(self, met, share):
        """Moves on; the work of the contact on it."""
        if not self.here:
            return 0.0
        before = self.place
        steady = (1.0 - self.g) * (self.last.force + self.eta * MODEL_B * self.velocity)
        for _ in range(4):
            drive = share * (self.g * MODEL_K * (self.anchor - self.place) + steady)
            self.place, self.speed = slide(self.place, self.speed, drive + met, TICK / 4, MODEL_M,
                                           MODEL_B, self.g * FRICTION)
        return met * (self.place - before)


class Peer:
    def __init__(self, task, side, draw):
        self.side = side
        self.hand = Hand(task, side, draw)
        self.world = World()
        self.intention = Intention()
        self.proxy = Proxy()
        self.account = self.lent = 0.0
        self.felt = self.work = 0.0
        self.touches = False
        self.touched = None
        self.corrected = 0.0
        self.past = []

    def tick(self, n, heard):
        before = self.hand.reported
        self.hand.move(n * TICK, self.felt)
        self.work -= self.felt * (self.hand.reported - before)
        proxy, world = self.proxy, self.world
        if heard is not None:
            self.account += proxy.hear(heard, (n - heard.n) * TICK)
        age = (n - proxy.last.n) * TICK if proxy.last is not None else 0.0
        proxy.look(world, age, self.touches)
        allowance = 0.030 + 0.4 * proxy.age_max
        self.account += max(0.0, allowance - self.lent)
        self.lent = max(self.lent, allowance)
        self.account = min(self.account, 2.0 * allowance)
        left = max(0.0, self.account - proxy.motion_j())
        share = math.sqrt(left / proxy.springs_j()) if proxy.springs_j() > left else 1.0

        other = (-self.side, proxy.place, proxy.speed) if proxy.here else None
        own, theirs = world.tick([(self.side, self.hand.reported, self.hand.velocity), other])
        self.touches = own != 0.0
        if self.touches:
            self.touched = n
        self.account += proxy.step(-theirs, share)
        if not self.touches:
            self.correct(n, age, theirs)
        self.past.append((world.x, self.corrected))
        felt_before = self.felt
        self.felt = -own * min(1.0, n * TICK)  # the governor lets forces in within a second
        self.intention.add(self.hand.reported, self.hand.velocity, felt_before)

        m = Message()
        m.n, m.touching, m.h, m.work, m.force = n, self.touches, self.hand.reported, self.work, own
        m.r, m.slope, m.x, m.v = self.intention.r, self.intention.slope, world.x, world.v
        return m

    def other_leads(self, n):
        m = self.proxy.last
        if m is None:
            return False
        latest = max((t for t in (self.touched, self.proxy.touched) if t is not None), default=None)
        if latest is None or (n - latest >= 500 and not self.touches and not m.touching):
            return self.side > 0
        return latest != self.touched

    def correct(self, n, age, push):
        if not self.other_leads(n):
            return
        m, ago = self.proxy.last, round(age / TICK)
        if m.touching:
            error = m.x + self.proxy.eta * age * m.v - self.world.x
        elif ago == 0 or ago > len(self.past):
            error = m.x - self.world.x
        else:
            x, corrected = self.past[-ago]
            error = m.x - x - (self.corrected - corrected)
        way = TICK * min(max(20.0 * error, -0.25), 0.25)
        self.world.x += way
        self.corrected += way
        self.account -= max(0.0, -push * way)


def mean_mm(task, delay_ms, seed):
    draw = random.Random(f"{task} {seed}")
    peers = [Peer(task, -1, draw), Peer(task, 1, draw)]
    sent = ([], [])
    total = 0.0
    ticks = round(RUNNING_S / TICK)
    for n in range(ticks):
        for i, peer in enumerate(peers):
            heard = sent[1 - i][n - delay_ms] if n >= delay_ms else None
            sent[i].append(peer.tick(n, heard))
        total += abs(peers[0].world.x - peers[1].world.x)
    return 1e3 * total / ticks


# --- the comparison ---
EXPERIMENT = """title = "remote-proxy beside its re-implementation"
kind = "plane"
seeds = {seeds}
first_seed = 1
algorithms = ["remote-proxy"]
tasks = ["T1", "T2", "T3"]
[plane]
delay = ["{delay}ms"]
jitter = ["0ms"]
loss = ["0%"]
"""


def lab_means(lab, delay_ms, seeds):
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder)
        experiment = out / "compare.toml"
        experiment.write_text(EXPERIMENT.format(seeds=seeds, delay=delay_ms))
        subprocess.run([lab, "run", experiment, "--out", out / "run"], check=True,
                       stdout=subprocess.DEVNULL)
        with open(out / "run" / "qos.csv", newline="") as file:
            rows = list(csv.DictReader(file))
    return {row["task"]: float(row["mean_mm"]) for row in rows}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lab", help="the program hapnet-lab, to compare with")
    parser.add_argument("--delay-ms", type=int, default=160)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--within", type=float, default=0.05, help="greatest difference, a share")
    asked = parser.parse_args()
    lab = lab_means(asked.lab, asked.delay_ms, asked.seeds) if asked.lab else {}
    worst = 0.0
    for task in ("T1", "T2", "T3"):
        own = [mean_mm(task, asked.delay_ms, seed) for seed in range(asked.seeds)]
        mean = sum(own) / len(own)
        line = f"{task}: {mean:.3f} mm"
        if task in lab:
            apart = mean / lab[task] - 1.0
            worst = max(worst, abs(apart))
            line += f", the lab {lab[task]:.3f} mm: {100.0 * apart:+.1f} %"
        print(line, flush=True)
    return 0 if worst <= asked.within else 1


if __name__ == "__main__":
    sys.exit(main())
