# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""What the programs write is as the JSON Schemas say, and the schemas know all of it.

schemas_test.py REPOSITORY BIN_DIR. Without jsonschema it is left out.
"""

import json
import re
import subprocess
import sys
import tempfile
import time
import tomllib
from pathlib import Path

from schemas import faults_in, faults_in_folder, validators

repository, programs = Path(sys.argv[1]), Path(sys.argv[2])
faults = []
validated = 0
used = set()


def validate(name, document, label):
    global validated
    validated += 1
    used.add(name)
    faults.extend(f"{label}: {fault}" for fault in faults_in(name, document))


def validate_folder(folder):
    global validated
    found, documents = faults_in_folder(folder)
    validated += documents
    faults.extend(found)


def refuses(name, document, label):
    if validators[name].is_valid(document):
        faults.append(f"{name} accepts {label}")


def run(program, *words, exit=0):
    """What it prints. exit: the code that it ends with; None: 0 or 1."""
    done = subprocess.run([programs / program, *map(str, words)], capture_output=True, text=True)
    if done.returncode not in ((0, 1) if exit is None else (exit,)):
        faults.append(f"{program} {' '.join(map(str, words))}: {done.stderr}")
    return done.stdout


def start(program, *words):
    return subprocess.Popen([programs / program, *map(str, words)],
                            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def session(folder, keyed):
    """Two peers through an emulator that does what has keys of its own in the statistics."""
    folder.mkdir()
    keys = ["--key"] if keyed else []
    if keyed:
        run("hapnet-peer", "keygen", "--peers", 2, "--out", folder / "keys")
    emulator = start("hapnet-emulator", "--listen-a", "127.0.0.1:7001", "--listen-b",
                     "127.0.0.1:7002", "--delay", "5ms", "--jitter", "1ms", "--loss", "5%",
                     "--rate", "10Mbit/s", "--stats", folder / "emulator.json", "--fates",
                     folder / "fates.csv", "--pcap", folder / "capture.pcapng", "--require",
                     "up.received>10")
    time.sleep(0.3)
    peers = []
    for peer in (1, 2):
        key = [*keys, folder / f"keys/peer-{peer}.key"] if keyed else []
        peers.append(start("hapnet-peer", "--id", peer, "--listen", f"127.0.0.1:{7002 + peer}",
                           "--remote", f"127.0.0.1:{7000 + peer}", "--task", "T3", "--duration",
                           "5s", "--record", folder / f"{peer}.rec", "--stats",
                           folder / f"{peer}.json", "--events",
                           folder / f"peer-{peer}-events.jsonl", *key))
    for peer in peers:
        if peer.wait(60) != 0:
            faults.append(f"a peer ended with {peer.returncode}")
    emulator.terminate()
    emulator.wait(10)
    validate("emulator", json.loads((folder / "emulator.json").read_text()), folder)
    for peer in (1, 2):
        stats = json.loads((folder / f"{peer}.json").read_text())
        validate("peer", stats, f"{folder}/{peer}.json")
        lines = (folder / f"peer-{peer}-events.jsonl").read_text().splitlines()
        for line in lines:
            validate("events", json.loads(line), f"{folder}: events of {peer}")
        events = [json.loads(line)["event"] for line in lines]
        wanted = ["met", "agreed", "started", "hands_off", "ended"]
        is_told = [event for event in events if event in wanted] == wanted
        if not is_told or keyed != ("sealed" in events):
            faults.append(f"{folder}: the events of {peer} are {events}")
        if (stats["secure"] is not None) != keyed:
            faults.append(f"{folder}: whether there is a key")
    return folder


def broken(name, document, form=None):
    """Documents that differ from a good one in one place. `form`: which of several it has."""
    schema = validators[name].schema
    required = [*schema.get("required", []), *(form or {}).get("required", [])]
    assert required
    for key in required:
        refuses(name, {k: v for k, v in document.items() if k != key}, f"one without {key}")
        refuses(name, {**document, key: {"no": ["such"]}}, f"an object of other keys as {key}")
    refuses(name, {**document, "no_such_key": 1}, "a key that is not listed")


with tempfile.TemporaryDirectory() as place:
    folder = Path(place)
    plain = session(folder / "plain", False)
    session(folder / "keyed", True)
    analysis = json.loads(run("hapnet-lab", "analyse", plain / "1.rec", plain / "2.rec", "--json"))
    validate("analysis", analysis, "analyse")

    service = start("hapnet-emulator", "probe", "--answer", "127.0.0.1:7101")
    relay = start("hapnet-emulator", "--listen", "127.0.0.1:7100", "--upstream", "127.0.0.1:7101",
                  "--delay", "2ms", "--stats", folder / "clients.json")
    time.sleep(0.3)
    probed = json.loads(run("hapnet-emulator", "probe", "127.0.0.1:7100", "--count", 20, "--rate",
                            100, "--json"))
    validate("probe", probed, "probe")
    for program in (relay, service):
        program.terminate()
        program.wait(10)
    clients = json.loads((folder / "clients.json").read_text())
    validate("emulator", clients, "clients")
    unanswered = run("hapnet-emulator", "probe", "127.0.0.1:7101", "--count", 2, "--rate", 20,
                     "--json", exit=1)
    validate("probe", json.loads(unanswered), "probe without an answer")
    verified = json.loads(run("hapnet-emulator", "verify", plain / "emulator.json", "--json"))
    validate("verification", verified, "verify")
    for words in (["lte"], ["wifi-busy", "--rate", 100], ["--loss", "93%"],
                  ["--link", "1-2", "--set", "1-2.delay=3ms"],
                  ["--jitter", "15ms", "--order", "free", "--reorder",
                   '{ share = "1%", displacement = 3 }']):
        predicted = json.loads(run("hapnet-emulator", "predict", *words, "--packets", 2000,
                                   "--json"))
        validate("prediction", predicted, f"predict {words}")
    run("hapnet-emulator", "--link", "1-2=127.0.0.1:7111,127.0.0.1:7112", "--link",
        "1-3=127.0.0.1:7113,127.0.0.1:7114", "--duration", "1s", "--stats", folder / "links.json")
    validate("emulator", json.loads((folder / "links.json").read_text()), "links")

    replayed = json.loads(run("hapnet-lab", "replay", plain / "1.rec", "--json"))
    validate("replay", replayed, "replay")
    other = run("hapnet-lab", "replay", plain / "1.rec", "--algorithm", "sep", "--json", exit=None)
    validate("replay", json.loads(other), "replay with another algorithm")
    for scene in sorted((repository / "scripts/scenes").glob("*.toml")):
        explained = json.loads(run("hapnet-lab", "explain", scene, "--json"))
        validate("explanation", explained, scene.name)
    examined = json.loads(run("hapnet-peer", "doctor", "--json", exit=None))
    validate("doctor", examined, "doctor")
    run("hapnet-peer", "self-test", "--device", "sim", "--read-for", "1s", "--json",
        folder / "self-test.json")
    tested = json.loads((folder / "self-test.json").read_text())
    validate("self-test", tested, "self-test")

    results = folder / "results"
    quick = ["--set", "duration=6s", "--seeds", 1, "--set", "tasks=T1"]
    for kind in ("fig7", "table1"):
        run("hapnet-lab", "run", kind, *quick, "--out", results / kind)
    run("hapnet-lab", "report", results)
    validate_folder(results)
    manifest = json.loads((results / "table1/manifest.json").read_text())
    several = json.loads((results / "manifest.json").read_text())
    run("hapnet-lab", "plan", "qos", "--quick", *quick, "--set", "algorithms=base", "--out",
        folder / "plan")
    for shard in ("0/2", "1/2"):
        run("hapnet-lab", "run", folder / "plan", "--shard", shard)
    run("hapnet-lab", "merge", folder / "plan")
    validate_folder(folder / "plan")
    plan = json.loads((folder / "plan/plan.json").read_text())
    lines = (folder / "plan/shards/0-of-2.jsonl").read_text().splitlines()

    for task in [*(f"T{n}" for n in range(1, 11)), "P1"]:
        played = json.loads(run("hapnet-lab", "play", "--task", task, "--delay", "20ms",
                                "--duration", "6s", "--json"))
        validate("play", played, f"play {task}")
    played = json.loads(run("hapnet-lab", "play", "--task", "T2", "--algorithm", "base",
                            "--algorithm", "sep", "--json"))
    validate("play", played, "play of two algorithms")
    compared = json.loads(run("hapnet-lab", "compare", results / "table1", results / "table1",
                              "--json"))
    validate("comparison", compared, "compare")

    for name, document in (("probe", probed), ("verification", verified),
                           ("prediction", predicted), ("play", played),
                           ("comparison", compared), ("replay", replayed),
                           ("explanation", explained), ("doctor", examined),
                           ("self-test", tested), ("plan", plan)):
        broken(name, document)
    broken("emulator", clients)
    broken("peer", json.loads((plain / "1.json").read_text()))
    broken("analysis", analysis)
    forms = validators["manifest"].schema["$defs"]
    broken("events", json.loads((plain / "peer-1-events.jsonl").read_text().splitlines()[0]))
    broken("manifest", manifest, forms["experiment"])
    broken("manifest", several, forms["several"])
    header, played = (json.loads(line) for line in lines[:2])
    for document, form in zip((header, played), validators["sessions"].schema["oneOf"]):
        validate("sessions", document, "a line of a shard")
        broken("sessions", document, form)

# Profiles: all that are shipped, those of the page that are whole, and each law of its tables.
for path in sorted((repository / "scripts/profiles").glob("*.toml")):
    validate("profile", tomllib.loads(path.read_text()), path.name)
page = (repository / "docs/formats/profile.md").read_text()
for text in re.findall(r"```toml\n(.*?)```", page, re.DOTALL):
    validate("profile", tomllib.loads(text), text)
examples = {"a time": "5ms", "a share": "1%", "a size": "64KiB", "a rate": "10Mbit/s",
            "a whole": 2, "a number": 3, "true": True, "a list: each": [1, 2],
            "a list of times": [["1s", "2s"]], "a text of 0": "0010", "a text": "x.csv"}


def example(value):
    if value.startswith("`"):
        return re.findall(r'"([^"]+)"', value)[0]
    return next(sample for start_, sample in examples.items() if value.startswith(start_))


def table(name):
    text = page[page.index(f"<!-- keys: {name} -->"):]
    rows = [line.strip("|").split(" | ") for line in text[:text.index("<!-- end")].splitlines()
            if line.startswith("| `")]
    return [[cell.strip() for cell in row] for row in rows]


for kind, key in (("delay-laws", "jitter"), ("loss-laws", "loss")):
    laws = {}
    for law, name, value, *_ in table(kind):
        laws.setdefault(law.strip("`"), {})[name.strip("`")] = example(value)
    assert len(laws) > 5
    for law, parameters in laws.items():
        whole = {"law": law, **parameters}
        validate("profile", {"both": {key: whole}}, f"{key} {law}")
        refuses("profile", {"both": {key: {**whole, "no_such": 1}}}, f"{law} with another key")
for bad in ({"both": {"delay": 40}}, {"both": {"delay": "40"}}, {"both": {"dealy": "40ms"}},
            {"both": {"loss": "2"}}, {"at": [{"both": {"delay": "1ms"}}]}, {"seed": "1"},
            {"both": {"order": "any"}}):
    refuses("profile", bad, str(bad))

# The rows of the benches: those of all are made by functions with these keys.
sys.path.insert(0, str(repository / "tests/bench/web"))
import rows  # noqa: E402

place = {"case": "c", "subject": "s", "baseline": "b"}
validate("bench", {"host": {"cpu": "a"}, "rows": [
    rows.row(place, "missed_ticks", 0, baseline_value=0, target=0), rows.row(place, "frames", 3),
    rows.row(place, "late_ratio", 0, baseline_value=1, target=2, direction="min")]}, "bench")

# Of the others there are documents in other tests: scripts/real-time.sh has attempts.
if unused := validators.keys() - used - {"attempt", "manifest", "sessions", "plan"}:
    faults.append(f"no document is validated by {unused}")
print(f"{validated} documents validated")
for fault in faults:
    print("FAULT", fault)
sys.exit(1 if faults or validated < 150 else 0)
