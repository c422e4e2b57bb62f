# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Runs whose outputs are the same to the byte in every run: virtual time, fixed seeds and files.

Commands are run in one folder, in the order of the table, with the programs in PATH. Later ones
read what earlier ones have written.
"""

import csv
import json
import shutil
import signal
import socket

from programs import Output, Step

TASKS = [f"T{n}" for n in range(1, 11)] + ["P1"]
ALGORITHMS = ("base", "dead-reckoning", "sep", "remote-proxy", "base-tdpa", "wave", "couple", "lag",
              "rollback")

# A profile with most of the settings that draw fates, and with none that depends on time.
LOSSY = """name = "lossy"

[both]
loss = { law = "gilbert", share = "5%", mean_burst = 3 }
delay = "2ms"
jitter = "1ms"
order = "free"
duplicate = "2%"
corrupt = "1%"

[down]
loss = ["2%", { law = "burst", lost = 2, of = 40 }]
reorder = { share = "3%", displacement = 2 }
"""
TURNS = """kind = "trajectories"
title = "A body that turns"
tasks = "T8"
scene = "turning"
duration = "6s"
algorithms = ["base", "remote-proxy"]
record = true

[both]
delay = "20ms"
loss = "2%"
"""

# Every built-in experiment in a small form: its own quick values, fewer seconds, seeds and points.
SMALL = "--quick --seeds 1 --set duration=6s"
TWO = f"{SMALL} --set tasks=T1 --set 'algorithms=[\"base\", \"sep\"]'"
DELAY = "--set limit.delay.step=160ms --set limit.delay.resolution=80ms"
JITTER = "--set limit.jitter.step=10ms --set limit.jitter.resolution=5ms"
LOSS = "--set limit.random-loss.resolution=5% --set limit.random-loss.step=20%"
BURST = "--set limit.burst-loss.step=40 --set limit.burst-loss.resolution=20"
INTERVAL = "--set limit.interval.step=20 --set limit.interval.resolution=10"
READINGS = f"{SMALL} --set tasks=T1 {DELAY} {JITTER} {LOSS} {BURST}"
EXPERIMENTS = {
    "any-network": f"{TWO} --set latin_hypercube.points=6",
    "beat": SMALL,
    "calibration": "--quick --seeds 1 --set duration=30s --set 'tasks=[\"T1\", \"T2\"]'",
    "fig6-other-tasks": f"{TWO} {DELAY} {JITTER} {LOSS} {BURST}",
    "fig6a": f"{TWO} {DELAY} {JITTER}",
    "fig6b": f"{TWO} {LOSS} {BURST}",
    "fig7": SMALL,
    "horizon": f"{READINGS} --set 'axis.values=[\"one-way\", \"none\"]'",
    "jitter-order": TWO,
    "limits-pool": f"{TWO} {DELAY} {JITTER} {LOSS} {BURST}",
    "many": f"{SMALL} --set 'algorithms=[\"base\"]' --set 'peers=[2, 3]'",
    "path-delay": f"{TWO} {LOSS} {BURST} --set 'axis.values=[\"0ms\", \"5ms\"]'",
    "plane": TWO,
    "qos": f"{TWO} {DELAY} {JITTER} {LOSS} {BURST} {INTERVAL}",
    "table1": f"--quick --seeds 2 --set duration=6s --set 'tasks=[\"T1\", \"T2\"]' "
              "--set record=true",
    "velocity-rule": f"{READINGS} --set 'axis.values=[\"nominal\", \"sender\"]'",
    "work-precision": f"{SMALL} --set tasks=T1",
    "work-precision-limits": f"{SMALL} --set tasks=T1",
}
RECORDS = "run/table1/records/base-T2/peer-1.rec run/table1/records/base-T2/peer-2.rec"
TURNING = "turns/records/base-T8/peer-1.rec turns/records/base-T8/peer-2.rec"


def groups(repository):
    """The steps of each golden file, by its name."""
    scenes = sorted(path.stem for path in (repository / "scripts/scenes").glob("*.toml"))
    profiles = sorted(path.stem for path in (repository / "scripts/profiles").glob("*.toml"))
    lab, emulator = "hapnet-lab", "hapnet-emulator"
    predicted = ("lte", "wifi-busy --rate 100", "--loss 93%",
                 "--jitter 15ms --order free --reorder '{ share = \"1%\", displacement = 3 }'",
                 "--rate 1Mbit/s --queue codel --sealed", "--link 1-2 --set 1-2.delay=3ms")
    return {
        "emulator-check": [
            Step(f"{emulator} check --list"),
            *(Step(f"{emulator} check {name}") for name in profiles),
            Step(f"{emulator} check --netem 'delay 80ms 5ms loss 1%'"),
            Step(f"{emulator} check lossy.toml --rate 100 --bytes 1000")],
        "emulator-predict": [
            step for words in predicted for step in (
                Step(f"{emulator} predict {words} --packets 2000"),
                Step(f"{emulator} predict {words} --packets 2000 --json", schema="prediction"))],
        "emulator-fates": [
            Step(relayed, files=["fates.csv"]),
            Step(f"{emulator} verify fates.csv --profile lossy.toml --seed 7"),
            Step(f"{emulator} verify fates.csv --profile lossy.toml --seed 7 --json",
                 schema="verification"),
            Step(f"{emulator} verify fates.csv --profile lossy.toml --seed 8 --json", exit=1,
                 schema="verification")],
        "emulator-learn": [*(Step(f"{emulator} learn {name} --plot")
                             for name in ("ping.txt", "irtt.json", "probe.csv", "delays.csv")),
                           Step(f"{emulator} learn delays.csv --json", schema="learn")],
        "peer-algorithms": [Step(f"hapnet-peer --print-algorithm {name}") for name in ALGORITHMS],
        "lab-explain": [Step(f"{lab} list"), *(
            step for name in scenes for step in (
                Step(f"{lab} explain {name}"),
                Step(f"{lab} explain {name} --json", schema="explanation")))],
        "lab-play": [
            *(step for task in TASKS for step in (
                Step(f"{lab} play --task {task} --delay 20ms --duration 6s"),
                Step(f"{lab} play --task {task} --delay 20ms --duration 6s --json",
                     schema="play"))),
            Step(f"{lab} play --task T2 --algorithm base --algorithm sep --loss 50%"),
            Step(f"{lab} play --task T2 --algorithm base --algorithm sep --loss 50% --json",
                 schema="play"),
            Step(f"{lab} play --task T7 --peers 4 --duration 6s --json", schema="play")],
        "lab-control": [Step(controlled_play)],
        "lab-run": [Step(f"{lab} run {name} {words} --out run/{name}", files=[f"run/{name}"])
                    for name, words in EXPERIMENTS.items()] + [Step(tables_agree)],
        "lab-plan": [
            Step(f"{lab} plan plane {TWO} --out plan", files=["plan/plan.json"]),
            *(Step(f"{lab} run plan --shard {n}/2", files=[f"plan/shards/{n}-of-2.jsonl"])
              for n in (0, 1)),
            Step(f"{lab} merge plan", files=["plan"]),
            Step(f"{lab} run plane {TWO} --set both.jitter=1ms --out other"),
            *(Step(f"{lab} compare plan other {words}", schema=schema)
              for words, schema in (("", None), ("--csv", None), ("--json", "comparison")))],
        "lab-hands": [
            Step(f"{lab} import hands hands.csv --columns ax,ay,az,bx,by,bz --units mm "
                 "--rate 100Hz --subject 01 --trial 1 --out people", files=["people/01-1-a.csv"]),
            Step(imported),
            Step(f"{lab} import hands hands.csv --columns ax,ay,az,bx,by,bz --units mm "
                 "--rate 100Hz --subject 01 --trial 2 --out people"),
            Step(f"{lab} fit hands people --out fitted", files=["fitted"])],
        "lab-records": [
            Step(f"{lab} run turns.toml --out turns", files=["turns"]),
            *(step for records in (RECORDS, TURNING) for step in (
                Step(f"{lab} analyse {records}"),
                Step(f"{lab} analyse {records} --json", schema="analysis"))),
            *(Step(f"{lab} export {records} {words}") for records, words in (
                (RECORDS.split()[0], "--rows ticks"), (RECORDS.split()[1], "--rows messages"),
                (TURNING.split()[0], "--rows bodies"), (RECORDS, ""))),
            *(step for record in (RECORDS.split()[0], TURNING.split()[1]) for step in (
                Step(f"{lab} replay {record}"),
                Step(f"{lab} replay {record} --json", schema="replay"),
                Step(f"{lab} replay {record} --csv"))),
            Step(f"{lab} replay {RECORDS.split()[0]} --algorithm sep"),
            Step(f"{lab} replay {RECORDS.split()[0]} --algorithm sep --json", schema="replay")],
        "lab-report": [
            Step(reports_folder),
            Step(f"{lab} report reported", files=["reported/manifest.json",
                                                  "reported/report.html"]),
            Step(f"{lab} report {RECORDS}", files=["run/table1/records/base-T2/report.html"]),
            Step(f"{lab} report {TURNING}",
                 files=["turns/records/base-T8/report.html"])],
    }


def outputs(programs, repository):
    """All outputs: pairs of the name of a golden file and an Output."""
    write_inputs(programs.place, repository)
    for name, steps in groups(repository).items():
        for step in steps:
            for output in programs.follow(step):
                yield name, output


def write_inputs(place, repository):
    (place / "lossy.toml").write_text(LOSSY)
    (place / "turns.toml").write_text(TURNS)
    measured = repository / "tests/fuzz/corpus/measurement"
    for source, name in (("ping", "ping.txt"), ("irtt", "irtt.json"), ("probe", "probe.csv")):
        shutil.copy(measured / source, place / name)
    delays = ["time_s,delay_ms"]
    for i in range(600):
        is_lost = i % 23 in (4, 5)
        delays.append(f"{i / 100:.2f},{'' if is_lost else f'{20 + i * 37 % 101 / 10:.1f}'}")
    (place / "delays.csv").write_text("\n".join(delays) + "\n")
    hands = ["ax,ay,az,bx,by,bz"]
    for i in range(200):
        gap = abs(i % 80 - 40)  # in mm, between two hands that meet and part
        hands.append(f"{-gap},{i % 7},0,{30 + gap},{i % 5},1")
    (place / "hands.csv").write_text("\n".join(hands) + "\n")


def relayed(programs):
    """Datagrams through a running emulator: which fates they have says the seed alone."""
    ends = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in "ab"]
    for end in ends:
        end.bind(("127.0.0.1", 0))
    known = [word for end, name in zip(ends, "ab")
             for word in (f"--{name}", "127.0.0.1:%d" % end.getsockname()[1])]
    emulator = programs.start("hapnet-emulator --listen-a 127.0.0.1:0 --listen-b 127.0.0.1:0 "
                              "--profile lossy.toml --seed 7 --fates fates.csv --control e.sock",
                              *known)
    ready = dict(word.split("=") for word in emulator.stdout.readline().split()[1:])
    for end, name, way, count in zip(ends, "ab", ("up", "down"), (400, 300)):
        host, port = ready[name].split(":")
        for at in range(0, count, 50):
            for number in range(at, at + 50):
                end.sendto(b"%0100d" % number, (host, int(port)))
            programs.run(f"hapnet-ctl e.sock wait --until {way}.received>={at + 50} --timeout 9s")
    emulator.send_signal(signal.SIGTERM)
    emulator.wait(10)
    for end in ends:
        end.close()
    return []


def imported(programs):
    """What was done to a recording of two hands."""
    text = (programs.place / "people/manifest.json").read_text(encoding="utf-8")
    return [Output("people/manifest.json", text, "json", "hands")]


def controlled_play(programs):
    """What the control sockets of a session in virtual time reply, and their frames."""
    lab = programs.start("hapnet-lab play --task T3 --delay 20ms --loss 2% --seed 3 --duration 6s "
                         "--algorithm base --algorithm sep --control lab.sock --pace paused "
                         "--out saved")
    yield Output("ready", lab.stdout.readline())
    network, peer, watch = (programs.connect(name)
                            for name in ("lab.sock", "lab.sock.peer-1", "lab.sock.peer-1"))
    for client, request in (
            (network, {"command": "pace", "do": "seek", "to_s": 2}),
            (network, {"command": "show"}), (network, {"command": "stats"}),
            (peer, {"command": "show"}), (peer, {"command": "stats"}),
            (network, {"command": "set", "settings": {"both.delay": "40ms"}}),
            (network, {"command": "set", "settings": {"both.dealy": "40ms"}}),
            (network, {"command": "pace", "do": "seek", "to_s": 2.5}),
            (network, {"command": "pace", "do": "save"})):
        yield Output(json.dumps(request), client.ask(request))
    # Frames of the paused session, so seldom that the second one comes after the step.
    frames = {"command": "watch", "what": "frames", "every": "500ms"}
    watch.send(frames)
    watching = programs.connect("lab.sock")
    yield Output("frame of the network", watching.ask(frames))
    step = {"command": "pace", "do": "step", "by_s": 1.1}
    yield Output(json.dumps(step), network.ask(step))
    yield Output("next frame of the network", watching.read())
    yield Output("frame of peer 1", watch.read())
    lab.send_signal(signal.SIGTERM)
    lab.wait(10)


# The columns of some tables that are in JSON alone.
IN_JSON_ALONE = {
    "table1": [f"{part}_{end}_mm" for part in ("mean", "std", "max") for end in ("low", "high")],
    "limits": ["band"], "precision": ["order"], "qos": ["limited_by"]}


def tables_agree(programs):
    """Each table in results.json and sessions.json is that of the CSV, before it was rounded."""
    said = []
    for folder in sorted((programs.place / "run").iterdir()):
        tables = {}
        for name in ("results.json", "sessions.json"):
            if (folder / name).exists():
                tables.update(json.loads((folder / name).read_text(encoding="utf-8"))["tables"])
        files = {str(path.relative_to(folder))[:-4] for path in folder.rglob("*.csv")}
        if files != tables.keys():
            raise AssertionError(f"{folder.name}: {files} and {tables.keys()}")
        for name, table in tables.items():
            with open(folder / f"{name}.csv", encoding="utf-8", newline="") as file:
                rows = list(csv.reader(file))
            places = [place for place, column in enumerate(table["columns"])
                      if column["key"] not in IN_JSON_ALONE.get(name.partition("_by_")[0], ())]
            columns = [table["columns"][place] for place in places]
            if [column["key"] for column in columns] != rows[0]:
                raise AssertionError(f"{folder.name}/{name}: other columns")
            if len(table["rows"]) != len(rows) - 1:
                raise AssertionError(f"{folder.name}/{name}: other rows")
            for cells, line in zip(table["rows"], rows[1:]):
                for column, place, text in zip(columns, places, line, strict=True):
                    cell = cells[place]
                    if not is_cell(cell, text, column.get("decimals")):
                        raise AssertionError(f"{folder.name}/{name}: {cell!r} and {text!r}")
        said.append(f"{folder.name}: {', '.join(sorted(tables))}")
    return [Output("tables that are the same in CSV and in JSON", "\n".join(said))]


def is_cell(cell, text, decimals):
    """Whether a cell of CSV is that of JSON, rounded to so many decimals; None: not rounded."""
    if cell is None or isinstance(cell, (bool, str)):
        return text == {None: "", True: "true", False: "false"}.get(cell, cell)
    if isinstance(cell, int) and decimals is None:
        return text == str(cell)
    if decimals is None:
        return float(text) == cell
    return len(text.partition(".")[2]) == decimals and \
        abs(float(text) - cell) <= 0.500001 * 10**-decimals


def reports_folder(programs):
    """The experiments whose reports differ: no two of these have the same measurements."""
    for name in ("any-network", "beat", "fig6a", "fig7", "many", "table1", "work-precision"):
        shutil.copytree(programs.place / "run" / name, programs.place / "reported" / name)
    return []
