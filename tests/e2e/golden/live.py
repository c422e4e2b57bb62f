# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Runs in real time, whose outputs have the same shape in every run."""

import json
import os
import re
import signal
import sys
import threading

from normal import masked, masked_numbers, page_of, shape_of_csv, shape_of_json, shape_of_metrics
from programs import Output

FRAMES = 120  # of each stream: enough to tell fixed decimals

PROFILE = """[both]
delay = "5ms"
jitter = "1ms"
loss = "5%"
rate = "10Mbit/s"

[[at]]
time = "200ms"
up.delay = "6ms"
"""

# Asks a hundred times, or answers until it is stopped.
TALK = """import os, socket, sys
end = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
if sys.argv[1] == "ask":
    end.settimeout(0.05)
    for _ in range(100):
        end.sendto(b"ask", (os.environ["HAPNET_B"], 7000))
        try:
            end.recv(100)
        except TimeoutError:
            pass
else:
    end.bind(("", 7000))
    while True:
        end.sendto(*end.recvfrom(100))
"""

# Paths of JSON whose values depend on the machine, with the words for their kind.
LOOSE = [
    (r"invalid_because$", "list of texts"), (r"invalid_because\[\]", "left out"),
    (r"(^|\.)(boot_id|socket)$", "text"), (r"peers\[\]\.says$", "text"),
    (r"governor(\.state)?$", "text"),
    (r"(^|\.)events$", "list"), (r"events\[\]\.generation$", "left out"),
    (r"findings\[\]\.fix$", "null or text"), (r"findings\[\]\.\w+$", "text"),
    # On a page: the length of the run in words, and whether the machine kept time.
    (r"^lead$", "text"), (r"^head\[\]\.", "left out"),
]
# In frames: figures that are missing at moments without data, or before the session is known.
LOOSE_FRAMES = [
    *LOOSE, (r"(left_out|repeated)$", "left out"), (r"phase$", "text"),
    (r"(^|\.)session$", "null or object"),
    (r"\.(delay_ms|late_us)$", "null or object"), (r"dropped\.(?!random_loss)", "left out"),
    (r"heard\[\]\.(age|offset|uncertainty)_ms$", "null or number"),
]
# Texts that depend on the machine.
WORDS = [(re.compile(pattern), replacement) for pattern, replacement in (
    (r"127\.0\.0\.1:\d+", "ADDRESS"),
    (r"/tmp/\w+", "PLACE"),
    (r"governor[= ](ramping|active|ready)", "governor STATE"),
    (r"(?m)^(valid|NOT VALID(\n  .*)*)$", "VALIDITY"),  # a peer that the machine kept waiting
    (r"(?<=  received) +\d+/s", " #/s"),  # of a peer: as wide as its column
    (r"; NOT VALID as a measurement: .*", ""),
    (r"(?<=passed   read       )\d+ reports", "# reports"),
    (r"(?m)(?<=\d  )#*$", "BAR"),  # of a histogram
    (r"(?m)^(ok  |warn|bad )  (?=\S).{15}  \S.*\n", "LEVEL SUBJECT TEXT\n"),  # of doctor
    (r"(?m)^ {23}fix: .*\n", ""),
    (r"(LEVEL .*\n)+", r"\1"),
)]


def shape_of_text(text, general=False):
    text = masked(text)
    for pattern, replacement in WORDS:
        text = pattern.sub(replacement, text)
    return masked_numbers(text, general)


def shaped(label, text, form="text", schema=None):
    """An output whose text is a shape."""
    if form == "json":
        shape = shape_of_json(masked(text), loose=LOOSE, units=True)
    elif form == "jsonl":
        shape = shape_of_json(*text.splitlines(), loose=LOOSE)
    elif form == "frames":
        shape = shape_of_json(*text.splitlines(), loose=LOOSE_FRAMES)
    elif form == "csv":
        shape = shape_of_csv(text)
    elif form == "metrics":
        shape = shape_of_metrics(text)
    elif form == "page":
        page, data = page_of(text)
        shape = shape_of_text(page, True) + "".join(
            f"-- data {name}\n{shape_of_json(one, loose=LOOSE)}" for name, one in data.items())
    else:
        shape = shape_of_text(text, form == "general")
    return Output(label, shape, "shape", schema, text)


def command(programs, words, form="text", exit=0, schema=None):
    """What a command prints; its messages where it prints nothing else."""
    done = programs.run(words, exit)
    return shaped(f"$ {words}", done.stdout or done.stderr, form, schema)


def outputs(programs, repository):
    """All outputs: pairs of the name of a golden file and an Output."""
    yield from session(programs, repository)
    for part in (probe, three, checks, between):
        for output in part(programs):
            yield part.__name__, output


def session(programs, repository):
    """Two peers with keys through an emulator, beside all that looks at them."""
    (programs.place / "path.toml").write_text(PROFILE)
    (programs.place / "kept").mkdir()
    programs.run("hapnet-peer keygen --peers 2 --out keys")
    emulator = programs.start(
        "hapnet-emulator --listen-a 127.0.0.1:0 --listen-b 127.0.0.1:0 --profile path.toml "
        "--stats emulator.json --fates fates.csv --pcap capture.pcapng --require up.received>10 "
        "--budget 1s --control e.sock --keep 5s --keep-in kept")
    line = emulator.stdout.readline()
    yield "session-emulator", shaped("ready", line)
    ready = dict(word.split("=") for word in line.split()[1:])
    peers = []
    for n, side, way in ((1, "a", "up"), (2, "b", "down")):  # one comes after the other
        peers.append(programs.start(
            f"hapnet-peer --id {n} --remote {ready[side]} --task T3 --duration 5s --key "
            f"keys/peer-{n}.key --control {n}.sock --record {n}.rec --stats {n}.json --events "
            f"{n}-events.jsonl --keep 5s --keep-in kept"))
        programs.run(f"hapnet-ctl e.sock wait --until {way}.received>0 --timeout 20s")
    web = server(programs, repository, "--emulator", "e.sock", "--peer", "1.sock", "--peer",
                 "2.sock")
    programs.run("hapnet-ctl 1.sock wait --until messages.states_received>100 --timeout 20s")
    watchers = [Watcher(programs.connect(f"{name}.sock"), name, schema)
                for name, schema in (("e", "emulator-frame"), ("1", "peer-frame"))]
    web.wait_for(lambda now: [peer["state"] for peer in now["peers"]] == ["running", "running"])
    live = LivePage(web)
    for name, output in control(programs):
        yield name, output
    yield from page(web)
    for watcher in (*watchers, live):
        yield from watcher.outputs()
    web.stop()
    for n, peer in enumerate(peers, 1):
        for name, text in zip(("stdout", "stderr"), peer.communicate(timeout=20)):
            yield "session-peer", shaped(f"{name} of peer {n}", text)
    yield "session-emulator", command(programs, "hapnet-ctl e.sock stop")
    yield "session-emulator", shaped("stderr", emulator.communicate(timeout=20)[1])
    yield from written(programs)


def control(programs):
    """The replies to every command, as texts and as they come."""
    name = "session-control"
    for words, form in (
            ("e.sock show", "general"), ("e.sock show --json", "json"), ("e.sock stats", "json"),
            ("e.sock stats --json", "json"), ("e.sock keep first", "text"),
            ("e.sock wait --until elapsed_s>0", "general"),
            ("e.sock wait --until elapsed_s>0 --json", "json"),
            ("e.sock set both.delay 7ms", "text"), ("e.sock set up.loss=6% --for 10s", "text"),
            ("e.sock set down.loss=6% --for 10s --json", "json"),
            ("e.sock show", "general"), ("e.sock show --json", "json"),
            ("e.sock diff path.toml", "text"), ("e.sock diff path.toml --json", "json"),
            ("e.sock apply path.toml", "text"), ("e.sock apply path.toml --json", "json"),
            ("e.sock reset", "text"), ("e.sock reset --json", "json"),
            ("1.sock show", "general"), ("1.sock show --json", "json"), ("1.sock stats", "json"),
            ("1.sock stats --json", "json"),
            ("1.sock keep first --json", "json"),
            ("1.sock wait --until elapsed_s>0", "general"),
            ("1.sock wait --until elapsed_s>0 --json", "json")):
        yield name, command(programs, f"hapnet-ctl {words}", form)
    for words, code in (("e.sock set x 1", 2), ("1.sock reset", 2), ("none.sock show", 3),
                        ("e.sock wait --until elapsed_s<0 --timeout 1ms", 1)):
        yield name, command(programs, f"hapnet-ctl {words}", exit=code)
    for socket in ("e.sock", "1.sock"):
        watch = programs.start(f"hapnet-ctl {socket} watch --every 200ms")
        lines = [watch.stdout.readline() for _ in range(2)]
        watch.send_signal(signal.SIGTERM)
        watch.communicate()
        yield name, shaped(f"$ hapnet-ctl {socket} watch --every 200ms", "".join(lines),
                           "general")


class Watcher(threading.Thread):
    """Takes the frames of a control socket."""

    def __init__(self, client, name, schema):
        super().__init__(daemon=True)
        self.client, self.name, self.schema, self.lines = client, name, schema, []
        self.start()

    def run(self):
        self.lines.append(self.client.ask(
            {"command": "watch", "what": "frames", "every": "20ms"}))
        while len(self.lines) < FRAMES:
            self.lines.append(self.client.read())

    def outputs(self):
        self.join()
        yield "session-frames", shaped(f"frames of {self.name}.sock", "".join(self.lines), "frames",
                                       self.schema)


class LivePage(threading.Thread):
    """Takes the messages of a WebSocket of hapnet-web."""

    def __init__(self, web):
        super().__init__(daemon=True)
        from served import Live
        self.live, self.texts = Live(web.port, web.token), {}
        self.start()

    def run(self):
        while len(self.texts.get("frame", [])) < FRAMES:
            kind = self.live.read()["type"]
            self.texts.setdefault(kind, []).append(self.live.text)
        self.live.close()

    def outputs(self):
        self.join()
        # Other messages come when something happens, and are in /api/state as well.
        yield "session-web", shaped("message hello", self.texts["hello"][0], "frames")
        yield "session-web", shaped("messages frame", "\n".join(self.texts["frame"]), "frames")


def server(programs, repository, *arguments):
    """hapnet-web; tests/e2e/web has its clients."""
    os.environ["HAPNET_BIN"] = str(programs.folder)
    sys.path.insert(0, str(repository / "tests/e2e/web"))
    from served import Server
    web = Server(*(str(programs.place / word) if word.endswith(".sock") else word
                   for word in arguments))
    programs.started.append(web.process)
    return web


def page(web):
    """What hapnet-web replies."""
    for path, form in (("/metrics", "metrics"), ("/api/state", "json"), ("/api/files", "json")):
        yield "session-web", shaped(f"GET {path}", web.ask("GET", path)[1].decode(), form)
    for path, body in (("/api/emulator", {"command": "set", "settings": {"both.delay": "8ms"}}),
                       ("/api/emulator", {"command": "set", "settings": {"both.dealy": "8ms"}}),
                       ("/api/emulator", {"command": "stats"}), ("/api/mark", {"text": "here"}),
                       ("/api/keep", {"name": "other", "last": "1s"}),
                       ("/api/pace", {"do": "show"})):
        yield "session-web", shaped(f"POST {path} {json.dumps(body)}",
                                    web.ask("POST", path, body)[1].decode(), "json")


def written(programs):
    """The files of the session, and what others make of them."""
    place = programs.place
    emulated = (place / "emulator.json").read_text()
    yield "session-emulator", shaped("emulator.json", emulated, "json", "emulator")
    yield "session-emulator", shaped("fates.csv", (place / "fates.csv").read_text(), "csv")
    yield "session-emulator", command(programs, "hapnet-emulator report emulator.json --out -",
                                      "page")
    yield "session-peer", shaped("1.json", (place / "1.json").read_text(), "json", "peer")
    yield "session-peer", shaped("2.json", (place / "2.json").read_text(), "json", "peer")
    yield "session-peer", shaped("1-events.jsonl", (place / "1-events.jsonl").read_text(), "jsonl",
                                 "events")
    yield "session-analysis", command(programs, "hapnet-lab analyse 1.rec 2.rec")
    yield "session-analysis", command(programs, "hapnet-lab analyse 1.rec 2.rec --json", "json",
                                      schema="analysis")
    yield "session-analysis", command(programs, "hapnet-lab export 1.rec --rows messages", "csv")


def probe(programs):
    """A ping through a relay with clients, and one that nothing answers."""
    service = programs.start("hapnet-emulator probe --answer 127.0.0.1:0")
    line = service.stdout.readline()
    yield shaped("ready of --answer", line)
    address = re.search(r"127\.0\.0\.1:\d+", line)[0]
    relay = programs.start(f"hapnet-emulator --listen 127.0.0.1:0 --upstream {address} --delay 2ms "
                           "--jitter 1ms --budget 1s --stats clients.json")
    line = relay.stdout.readline()
    yield shaped("ready of --upstream", line)
    relayed = re.search(r"listen=(\S+)", line)[1]
    for words, form in (("--csv probe.csv", "text"), ("--quiet", "text"), ("--json", "json")):
        output = command(programs, f"hapnet-emulator probe {relayed} --count 20 --rate 200 {words}",
                         form, schema="probe" if form == "json" else None)
        output.label = f"$ hapnet-emulator probe ADDRESS {words}"
        yield output
    yield shaped("probe.csv", (programs.place / "probe.csv").read_text(), "csv")
    for program in (relay, service):
        program.send_signal(signal.SIGTERM)
        yield shaped("stderr", program.communicate(timeout=20)[1])
    yield shaped("clients.json", (programs.place / "clients.json").read_text(), "json", "emulator")
    for words, form in (("", "text"), ("--json", "json")):
        output = command(programs, f"hapnet-emulator probe {address} --count 2 --rate 100 --wait "
                         f"100ms {words}", form, exit=1, schema="probe" if words else None)
        output.label = f"$ hapnet-emulator probe UNANSWERED {words}"
        yield output


def three(programs):
    """Three peers, a link for every two, and a body that turns."""
    links = " ".join(f"--link {pair}=127.0.0.1:0,127.0.0.1:0" for pair in ("1-2", "1-3", "2-3"))
    emulator = programs.start(f"hapnet-emulator {links} --delay 5ms --jitter 1ms --loss 5% "
                              "--set 1-3.delay=8ms --budget 1s --stats links.json")
    line = emulator.stdout.readline()
    yield shaped("ready", line)
    ends = {pair: both.split(",") for pair, both in
            (word.split("=") for word in line.split() if re.match(r"\d-\d=", word))}
    peers = [programs.start(f"hapnet-peer --id {n} --task T8 --duration 4s --record of-{n}.rec "
                            f"--stats of-{n}.json "
                            + " ".join(f"--peer {other}={ends[pair][side]}" for other, pair, side
                                       in others))
             for n, others in ((1, ((2, "1-2", 0), (3, "1-3", 0))),
                               (2, ((1, "1-2", 1), (3, "2-3", 0))),
                               (3, ((1, "1-3", 1), (2, "2-3", 1))))]
    for peer in peers:
        peer.communicate(timeout=30)
    emulator.send_signal(signal.SIGTERM)
    emulator.communicate(timeout=20)
    yield shaped("links.json", (programs.place / "links.json").read_text(), "json", "emulator")
    yield shaped("of-1.json", (programs.place / "of-1.json").read_text(), "json", "peer")
    yield command(programs, "hapnet-lab analyse of-1.rec of-2.rec of-3.rec")
    yield command(programs, "hapnet-lab analyse of-1.rec of-2.rec of-3.rec --json", "json",
                  schema="analysis")
    yield command(programs, "hapnet-lab export of-1.rec --rows bodies", "csv")


def checks(programs):
    """What looks at the machine and its devices, and how a peer ends."""
    yield command(programs, "hapnet-peer doctor", exit=None)
    yield command(programs, "hapnet-peer doctor --json", "json", exit=None, schema="doctor")
    yield command(programs, "hapnet-peer list-devices")
    yield command(programs, "hapnet-peer list-devices --json", "json")
    yield command(programs, "hapnet-peer self-test --device sim --read-for 1s --json tested.json")
    yield shaped("tested.json", (programs.place / "tested.json").read_text(), "json", "self-test")
    peer = programs.start("hapnet-peer --id 1 --remote 127.0.0.1:9 --control alone.sock")
    peer.stdout.readline()
    yield command(programs, "hapnet-ctl alone.sock show", "general")
    yield command(programs, "hapnet-ctl alone.sock estop")
    yield command(programs, "hapnet-ctl alone.sock stop")
    peer.communicate(timeout=20)


def between(programs):
    """Two commands in networks of their own, where the system lets users make these."""
    (programs.place / "talk.py").write_text(TALK)
    done = programs.run("hapnet-emulator between --delay 5ms --jitter 1ms --loss 5% --budget 1s "
                        "--stats between.json -- python3 talk.py ask --- "
                        "python3 talk.py answer", exit=None)
    if done.returncode == 3:
        yield Output("between", None)
        return
    yield shaped("$ hapnet-emulator between", done.stdout + done.stderr)
    yield shaped("between.json", (programs.place / "between.json").read_text(), "json", "emulator")
