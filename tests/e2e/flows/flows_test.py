# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Flows end to end, judged by sockets of Python and by the statistics: two flows and the rest, each
with the delay and the loss that it was given, through between and through --upstream.

Usage: flows_test.py FOLDER-WITH-THE-PROGRAMS
"""

import json
import math
import os
import pathlib
import select
import socket
import statistics
import struct
import subprocess
import sys
import tempfile
import threading
import time

PROFILE = """
[both]
delay = "20ms"
[[flow]]
name = "voice"
match = { protocol = "udp", port = %(voice)d }
both.delay = "80ms"
up.loss = "2%%"
[[flow]]
name = "ssh"
match = { protocol = "tcp", port = %(ssh)d }
pass = true
"""
VOICE, OTHER, SSH = 5004, 6000, 22
COUNT = 1500  # datagrams of each flow
SPACING = 0.002


def require(condition, text):
    if not condition:
        raise SystemExit(f"FAILED: {text}")


def bind(family, address):
    udp = socket.socket(family, socket.SOCK_DGRAM)
    udp.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 22)
    udp.bind(address)
    return udp


def answer(sockets, seconds):
    """Sends back what comes, with the time at which it came."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        for udp in select.select(sockets, [], [], 0.1)[0]:
            data, sender = udp.recvfrom(2048)
            udp.sendto(data[:12] + struct.pack("<d", time.monotonic()), sender)


def echo_lines(address):
    """A server of TCP that sends back each line."""
    server = socket.create_server(address)

    def serve():
        connection, _ = server.accept()
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        while data := connection.recv(100):
            connection.sendall(data)

    threading.Thread(target=serve, daemon=True).start()


def probe(ends, count=COUNT):
    """Sends to each (socket, address) in turn; gives of each the delays up, down, and what never
    arrived at the other side or here. Both sides have one clock."""
    delays = {udp: ([], []) for udp, _ in ends}

    def read(seconds):
        for udp in select.select(list(delays), [], [], seconds)[0]:
            data, _ = udp.recvfrom(2048)
            now = time.monotonic()
            _, sent, received = struct.unpack("<Idd", data)
            delays[udp][0].append(received - sent)
            delays[udp][1].append(now - received)

    begin = time.monotonic()
    for i in range(count):
        for udp, address in ends:
            udp.sendto(struct.pack("<Id", i, time.monotonic()), address)
        while (left := begin + (i + 1) * SPACING - time.monotonic()) > 0:
            read(left)
    end = time.monotonic() + 0.6
    while time.monotonic() < end:
        read(0.05)
    return [(statistics.median(delays[udp][0]), statistics.median(delays[udp][1]),
             count - len(delays[udp][0])) for udp, _ in ends]


def host_b():
    echo_lines(("10.0.0.2", SSH))
    sockets = [bind(socket.AF_INET, ("10.0.0.2", port)) for port in (VOICE, OTHER)]
    answer(sockets, 20)


def host_a(out):
    time.sleep(0.3)
    ends = [(bind(socket.AF_INET, ("10.0.0.1", 0)), ("10.0.0.2", port))
            for port in (VOICE, OTHER)]
    figures = {"udp": probe(ends)}
    tcp = socket.create_connection(("10.0.0.2", SSH))
    tcp.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    trips = []
    for _ in range(50):
        begin = time.monotonic()
        tcp.sendall(b"line\n")
        tcp.recv(100)
        trips.append(time.monotonic() - begin)
    figures["ssh"] = statistics.median(trips)
    pathlib.Path(out).write_text(json.dumps(figures), encoding="utf-8")


def check_identity(way, what):
    dropped = sum(way["dropped"].values())
    require(way["received"] + way["duplicated"]
            == way["delivered"] + dropped + way["in_flight"], f"identity of {what}: {way}")


def check_sums(run):
    flows = run["flows"]
    for direction in ("up", "down"):
        check_identity(run[direction], direction)
        for name, flow in flows.items():
            check_identity(flow[direction], f"{name} {direction}")
        for key in ("received", "delivered", "in_flight", "bytes_in"):
            total = sum(flow[direction][key] for flow in flows.values())
            require(run[direction][key] == total,
                    f"{key} {direction}: {run[direction][key]} in all, {total} by flows")


def check_share(lost, share, count, what):
    """Within 4.5 standard deviations of a binomial law."""
    sd = math.sqrt(count * share * (1 - share))
    require(abs(lost - count * share) <= 4.5 * sd, f"{what}: {lost} of {count} lost")


def check_voice_and_rest(figures, run, count):
    voice, rest = figures
    for (up, down, _), asked, name in ((voice, 0.080, "voice"), (rest, 0.020, "rest")):
        for figure, way in ((up, "up"), (down, "down")):
            require(asked <= figure < asked + 0.005, f"{name} {way}: {figure * 1e3:.2f} ms")
    check_share(voice[2], 0.02, count, "voice, by the prober")
    require(rest[2] == 0, f"the rest lost {rest[2]}")
    own = run["flows"]["voice"]["up"]
    require(own["received"] == count, f"voice: {own['received']} of {count} received")
    require(own["dropped"]["random_loss"] == voice[2],
            f"voice lost {voice[2]}, and says {own['dropped']}")
    for name, asked in (("voice", 80.0), ("rest", 20.0)):
        mean = run["flows"][name]["up"]["lens"]["delay_ms"]["p50"]
        require(asked <= mean < asked + 5, f"{name} says {mean} ms")
    check_sums(run)


def rows(path):
    lines = pathlib.Path(path).read_text(encoding="utf-8").splitlines()
    head = lines[0].split(",")
    return head, [dict(zip(head, line.split(","))) for line in lines[1:]]


def check_between(emulator, folder):
    profile = folder / "flows.toml"
    profile.write_text(PROFILE % {"voice": VOICE, "ssh": SSH}, encoding="utf-8")
    me = [sys.executable, os.path.abspath(__file__)]
    command = [emulator, "between", "--profile", str(profile), "--stats", str(folder / "b.json"),
               "--fates", str(folder / "b.csv"), "--seed", "7", "--",
               *me, "host-a", str(folder / "a.json"), "---", *me, "host-b"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    if done.returncode == 3:
        print("between: skipped, no networks of one's own here")
        return
    require(done.returncode == 0, f"between: {done.returncode}\n{done.stderr}")
    figures = json.loads((folder / "a.json").read_text(encoding="utf-8"))
    run = json.loads((folder / "b.json").read_text(encoding="utf-8"))
    check_voice_and_rest(figures["udp"], run, COUNT)
    require(figures["ssh"] < 0.010, f"ssh took {figures['ssh'] * 1e3:.1f} ms")
    require(run["flows"]["ssh"]["up"]["received"] >= 50, "no packets of ssh were seen")
    head, fates = rows(folder / "b.csv")
    require(head[:2] == ["flow", "direction"], f"columns {head}")
    require({row["flow"] for row in fates} == {"voice", "ssh", "rest"}, "flows of the fates")
    numbers = [int(row["number"]) for row in fates
               if row["flow"] == "voice" and row["direction"] == "up"]
    require(numbers == list(range(COUNT)), "numbers of voice")
    print("between: voice {0[0][0]:.4f} s up, {0[0][2]} lost; rest {0[1][0]:.4f} s; ssh {1:.5f} s "
          "round trip".format(figures["udp"], figures["ssh"]))


def start_upstream(emulator, folder, profile, server, extra):
    run = subprocess.Popen(
        [emulator, "--listen", "127.0.0.1:0", "--upstream", f"127.0.0.1:{server}", "--profile",
         str(profile), "--stats", str(folder / "u.json"), "--control", str(folder / "u.sock"),
         *extra], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    line = run.stdout.readline()
    require(line.startswith("ready"), line + (run.stderr.read() if not line else ""))
    return run, int(line.split("listen=127.0.0.1:")[1].split()[0])


def ask(folder, request):
    with socket.socket(socket.AF_UNIX) as control:
        control.connect(str(folder / "u.sock"))
        control.sendall(json.dumps(request).encode() + b"\n")
        return json.loads(control.makefile().readline())


def check_upstream(emulator, folder):
    """Two sockets of one machine: the port of the first is that of voice."""
    server = bind(socket.AF_INET, ("127.0.0.1", 0))
    clients = [bind(socket.AF_INET, ("127.0.0.1", 0)) for _ in range(2)]
    profile = folder / "upstream.toml"
    profile.write_text(PROFILE % {"voice": clients[0].getsockname()[1], "ssh": SSH},
                       encoding="utf-8")
    fates = folder / "u.csv"
    run, port = start_upstream(emulator, folder, profile, server.getsockname()[1],
                               ["--fates", str(fates), "--seed", "7"])
    threading.Thread(target=answer, args=([server], 15), daemon=True).start()
    figures = probe([(client, ("127.0.0.1", port)) for client in clients])
    told = ask(folder, {"command": "stats"})
    check_sums(told)
    changed = ask(folder, {"command": "set", "settings": {"flow.voice.up.delay": "200ms"}})
    require(changed["ok"] and changed["changed"], changed)
    at = changed["effective_at"]["client.1"]
    require(at["flows"]["voice"]["up"] == COUNT and at["flows"]["ssh"]["up"] == 0, at)
    later = probe([(client, ("127.0.0.1", port)) for client in clients], 200)
    require(0.2 <= later[0][0] < 0.205 and 0.02 <= later[1][0] < 0.025, f"after the change {later}")
    wrong = ask(folder, {"command": "set", "settings": {"flow.voise.up.delay": "200ms"}})
    require(not wrong["ok"] and "did you mean 'voice'" in wrong["error"], wrong)
    metrics = json.dumps(ask(folder, {"command": "metrics"}))
    require("voice" in metrics, "metrics name no flow")
    ask(folder, {"command": "stop"})
    run.communicate(timeout=10)
    require(run.returncode == 0, f"--upstream: {run.returncode}")
    end = json.loads((folder / "u.json").read_text(encoding="utf-8"))
    check_sums(end)
    for client in end["clients"]:
        check_sums(client)
    check_share(figures[0][2], 0.02, COUNT, "voice by --upstream")
    require(figures[1][2] == 0, f"the rest lost {figures[1][2]}")
    for (up, down, _), asked in zip(figures, (0.080, 0.020)):
        require(asked <= up < asked + 0.005 and asked <= down < asked + 0.005, f"{figures}")
    lost = end["flows"]["voice"]["up"]["dropped"]["random_loss"]
    require(lost == figures[0][2] + later[0][2], f"voice says {lost} lost, {figures}, {later}")
    head, _ = rows(fates)
    require(head[:3] == ["link", "flow", "direction"], f"columns {head}")
    print("--upstream: voice {0[0][0]:.4f} s up, {0[0][2]} lost; rest {0[1][0]:.4f} s".format(
        figures))


def check_refusals(emulator, folder):
    """What cannot be is refused with words, and exit code 2."""
    def refused(profile, options, words):
        file = folder / "wrong.toml"
        file.write_text(profile, encoding="utf-8")
        done = subprocess.run([emulator, "--profile", str(file), *options], capture_output=True,
                              text=True, timeout=20, check=False)
        require(done.returncode == 2 and words in done.stderr,
                f"{profile!r}: {done.returncode} {done.stderr}")
    pair = ["--listen-a", "127.0.0.1:0", "--listen-b", "127.0.0.1:0", "--duration", "1ms"]
    flow = '[[flow]]\nname = "voice"\nmatch = { %s }\n'
    refused(flow % 'dscp = "ef"', pair, "dscp")
    refused(flow % 'protocol = "arp"', pair, "arp")
    refused(flow % "port = 5004", [*pair, "--set", "flow.voise.delay=5ms"], "did you mean 'voice'")
    refused(flow % "prot = 5004", pair, "unknown key 'prot'")


def run_of_pair(emulator, folder, name, options):
    """A sends 400 datagrams from the port of voice to B, which has sent one before."""
    end_a, end_b = (bind(socket.AF_INET, ("127.0.0.1", 0)) for _ in range(2))
    profile = folder / "pair.toml"
    if not profile.exists():
        profile.write_text('[[flow]]\nname = "voice"\nmatch = { size = "100.." }\n'
                           'up.loss = "10%"\nboth.delay = "8ms"\n', encoding="utf-8")
    run = subprocess.Popen(
        [emulator, "--listen-a", "127.0.0.1:0", "--listen-b", "127.0.0.1:0", "--profile",
         str(profile), "--seed", "7", "--stats", str(folder / f"{name}.json"), "--fates",
         str(folder / f"{name}.csv"), *options],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    ready = dict(word.split("=", 1) for word in run.stdout.readline().split()[1:])
    to_a, to_b = (int(ready[side].rsplit(":", 1)[1]) for side in ("a", "b"))
    end_b.sendto(b"small", ("127.0.0.1", to_b))
    time.sleep(0.1)
    for _ in range(400):
        end_a.sendto(b"x" * 100, ("127.0.0.1", to_a))
        end_a.sendto(b"small", ("127.0.0.1", to_a))
        time.sleep(0.0005)
    time.sleep(0.2)
    run.terminate()
    _, said = run.communicate(timeout=10)
    require(run.returncode == 0, f"{name}: {run.returncode} {said}")
    return [row for row in rows(folder / f"{name}.csv")[1] if row["flow"] == "voice"]


def check_records(emulator, folder):
    """What a run writes is verified, drawn and replayed by flow."""
    def done(*words):
        return subprocess.run([emulator, *words], capture_output=True, text=True, timeout=30,
                              check=False)
    first = run_of_pair(emulator, folder, "first", [])
    require(len(first) == 400, f"{len(first)} datagrams of voice")
    stats = str(folder / "first.json")
    verified = done("verify", stats, "--flow", "voice")
    require(verified.returncode == 0 and "400 fates, none deviates" in verified.stdout,
            verified.stdout + verified.stderr)
    unknown = done("verify", stats, "--flow", "voise")
    require(unknown.returncode == 2, unknown.stdout)
    page = done("report", stats, "--flow", "voice", "--out", str(folder / "page.html"))
    require(page.returncode == 0, page.stderr)
    require("hapnet-data" in (folder / "page.html").read_text(encoding="utf-8"), "no data")
    again = run_of_pair(emulator, folder, "again",
                        ["--replay", str(folder / "first.csv"), "--set", "flow.voice.loss=90%"])
    require(again == first, "the replayed fates differ")
    predicted = done("predict", str(folder / "pair.toml"), "--flow", "voice", "--json")
    require(predicted.returncode == 0, predicted.stderr)
    require("up" in json.loads(predicted.stdout), predicted.stdout)


def check_python(emulator, folder):
    """The same by the package."""
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "python"))
    os.environ["HAPNET_BIN"] = os.path.dirname(emulator)
    from hapnet.emulator import Emulator  # pylint: disable=import-outside-toplevel
    profile = folder / "flows.toml"
    profile.write_text(PROFILE % {"voice": VOICE, "ssh": SSH}, encoding="utf-8")
    with Emulator(profile=str(profile), seed=7) as network:
        reply = network.set(flow="voice", up_delay="90ms", loss="1%")
        require(reply["changed"] and "voice" in reply["effective_at"]["flows"], reply)
        shown = network.control.request("show")
        require(shown["conditions"]["flow.voice.up.delay"] == "90ms", shown["conditions"])
        require(shown["conditions"]["up.delay"] == "20ms", shown["conditions"])
        again = network.apply(profile=shown["profile"])
        require(again["ok"], again)
        require(network.control.request("show")["conditions"] == shown["conditions"],
                "show does not print what apply reads")


def main():
    if sys.argv[1] == "host-a":
        return host_a(sys.argv[2])
    if sys.argv[1] == "host-b":
        return host_b()
    emulator = os.path.join(os.path.realpath(sys.argv[1]), "hapnet-emulator")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        check_refusals(emulator, folder)
        check_between(emulator, folder)
        check_upstream(emulator, folder)
        check_records(emulator, folder)
        check_python(emulator, folder)
    return None


main()
