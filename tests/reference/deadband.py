#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""The deadband of --send once more, after docs/formats/wire.md#fewer-messages.

    tests/reference/deadband.py --lab build/release/bin/hapnet-lab

plays a recorded hand that pushes the cube, beside one that does nothing, once with a message in
each tick and then with deadbands. From the messages of the first session this model picks those
that a deadband sends: they are to be those of the other sessions, each at the same time. Exits with
1 where one differs.
"""
import argparse
import math
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))

from hapnet.record import read_record  # noqa: E402 pylint: disable=wrong-import-position
from hapnet.wire import State, decode  # noqa: E402 pylint: disable=wrong-import-position

SECONDS = 9
POLICIES = (("deadband:8%", 0.08, 50), ("deadband:2%", 0.02, 50), ("deadband:20%,100ms", 0.2, 100))
EXPERIMENT = """
title = "reference"
kind = "table1"
tasks = ["T3"]
seeds = 1
algorithms = ["base"]
duration = "{seconds}s"
record = true
replay = ["{folder}/a.csv", "{folder}/b.csv"]
send = "{send}"
"""


def write_hands(folder):
    """A pushes the cube and swings, B stays away."""
    with open(folder / "a.csv", "w", encoding="utf-8") as file:
        file.write("time_s,x_m,y_m,z_m\n")
        for i in range(1000 * SECONDS):
            t = 1e-3 * i
            x = -0.035 + 0.012 * math.sin(2.0 * t) + 0.004 * math.sin(9.0 * t)
            file.write(f"{t:.3f},{x:.9f},{0.01 * math.sin(3.0 * t):.9f},0.002\n")
    with open(folder / "b.csv", "w", encoding="utf-8") as file:
        file.write("time_s,x_m,y_m,z_m\n0,0.1,0,0\n1,0.1,0,0\n")


def states_of_a(lab, folder, send):
    """What B received of A, in a session in which A sends so."""
    name = send.replace(":", "-").replace("%", "").replace(",", "-")
    experiment = folder / f"{name}.toml"
    experiment.write_text(EXPERIMENT.format(seconds=SECONDS, folder=folder, send=send),
                          encoding="utf-8")
    out = folder / name
    subprocess.run([lab, "run", str(experiment), "--out", str(out)], check=True,
                   stdout=subprocess.DEVNULL)
    record = read_record(str(next(out.glob("records/*/peer-2.rec"))))
    messages = (decode(bytes(one)) for one in record.messages.column("bytes"))
    return [one for one in messages if isinstance(one, State)]


def length(*values):
    return math.sqrt(sum(value * value for value in values))


def difference(a, b):
    return length(*(x - y for x, y in zip(a, b)))


def is_due(state, last, share, silence_ms):
    """Whether the page has this state sent after the last one that was."""
    if (state.touching, state.holding) != (last.touching, last.holding):
        return True
    if difference(state.contact_force, last.contact_force) > max(
            share * length(*last.contact_force), 0.02):
        return True
    if difference(state.hip_velocity, last.hip_velocity) > max(
            share * length(*last.hip_velocity), 5e-3):
        return True
    seconds = 1e-9 * (state.sent - last.sent)
    way = [seconds * v for v in last.hip_velocity]
    predicted = [x + moved for x, moved in zip(last.hip, way)]
    if difference(state.hip, predicted) > max(share * length(*way), 1e-4):
        return True
    return state.sent - last.sent >= 1_000_000 * silence_ms


def picked(states, share, silence_ms):
    sent = []
    for state in states:
        if not sent or is_due(state, sent[-1], share, silence_ms):
            sent.append(state)
    return [state.sent for state in sent]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--lab", required=True)
    lab = parser.parse_args().lab
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_hands(folder)
        every = states_of_a(lab, folder, "every:1")
        wrong = False
        for send, share, silence_ms in POLICIES:
            expected = picked(every, share, silence_ms)
            sent = [state.sent for state in states_of_a(lab, folder, send)]
            same = expected == sent
            wrong = wrong or not same or len(sent) < 100
            print(f"{send}: {len(sent)} of {len(every)} messages, "
                  f"{'as' if same else 'NOT as'} the model has them ({len(expected)})")
    return 1 if wrong else 0


sys.exit(main())
