# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""What the programs write is as the JSON Schemas say, and the schemas know all of it.

schemas_test.py REPOSITORY BIN_DIR. Keys that a schema does not list are errors here, though not to
its users: later versions may add some. Without jsonschema it is left out.
"""

import json
import re
import subprocess
import sys
import tempfile
import time
import tomllib
from pathlib import Path

try:
    from jsonschema import Draft202012Validator
except ImportError:
    print("skipped: the module jsonschema is missing (Debian: python3-jsonschema)")
    sys.exit(77)

repository, programs = Path(sys.argv[1]), Path(sys.argv[2])
faults = []
validated = 0


def strict(schema):
    """The same schema, to which keys that it does not list are errors."""
    if isinstance(schema, list):
        return [strict(one) for one in schema]
    if not isinstance(schema, dict):
        return schema
    copy = {key: strict(value) for key, value in schema.items()}
    if "properties" in copy and "additionalProperties" not in copy:
        copy["additionalProperties"] = False
    return copy


def validator(name):
    schema = json.loads((repository / f"docs/formats/schemas/{name}.schema.json").read_text())
    Draft202012Validator.check_schema(schema)
    return Draft202012Validator(strict(schema))


validators = {name: validator(name)
              for name in ("emulator", "peer", "analysis", "manifest", "profile", "play",
                           "prediction", "verification", "probe", "comparison")}


def validate(name, document, label):
    global validated
    validated += 1
    for error in validators[name].iter_errors(document):
        faults.append(f"{label}: {'.'.join(map(str, error.absolute_path))}: {error.message[:200]}")


def refuses(name, document, label):
    if validators[name].is_valid(document):
        faults.append(f"{name} accepts {label}")


def run(program, *words, exit=0):
    done = subprocess.run([programs / program, *map(str, words)], capture_output=True, text=True)
    if done.returncode != exit:
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
                           folder / f"{peer}.json", *key))
    for peer in peers:
        if peer.wait(60) != 0:
            faults.append(f"a peer ended with {peer.returncode}")
    emulator.terminate()
    emulator.wait(10)
    validate("emulator", json.loads((folder / "emulator.json").read_text()), folder)
    for peer in (1, 2):
        stats = json.loads((folder / f"{peer}.json").read_text())
        validate("peer", stats, f"{folder}/{peer}.json")
        if (stats["secure"] is not None) != keyed:
            faults.append(f"{folder}: whether there is a key")
    return folder


def broken(name, document):
    """Documents that differ from a good one in one place."""
    required = validators[name].schema["required"]
    for key in required:
        refuses(name, {k: v for k, v in document.items() if k != key}, f"one without {key}")
        refuses(name, {**document, key: {"no": "such"}}, f"an object of other keys as {key}")
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

    for kind in ("fig7", "table1"):
        run("hapnet-lab", "run", kind, "--set", "duration=6s", "--seeds", 1, "--set", "tasks=T1",
            "--out", folder / kind)
        manifest = json.loads((folder / kind / "manifest.json").read_text())
        validate("manifest", manifest, kind)

    for task in [*(f"T{n}" for n in range(1, 11)), "P1"]:
        played = json.loads(run("hapnet-lab", "play", "--task", task, "--delay", "20ms",
                                "--duration", "6s", "--json"))
        validate("play", played, f"play {task}")
    played = json.loads(run("hapnet-lab", "play", "--task", "T2", "--algorithm", "base",
                            "--algorithm", "sep", "--json"))
    validate("play", played, "play of two algorithms")
    compared = json.loads(run("hapnet-lab", "compare", folder / "table1", folder / "table1",
                              "--json"))
    validate("comparison", compared, "compare")

    for name, document in (("probe", probed), ("verification", verified),
                           ("prediction", predicted), ("play", played),
                           ("comparison", compared)):
        broken(name, document)
    broken("emulator", clients)
    broken("peer", json.loads((plain / "1.json").read_text()))
    broken("analysis", analysis)
    broken("manifest", manifest)

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

print(f"{validated} documents validated")
for fault in faults:
    print("FAULT", fault)
sys.exit(1 if faults or validated < 60 else 0)
