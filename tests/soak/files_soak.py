#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Files of every kind, changed at random, to the programs that read them.

Usage: files_soak.py SOURCE BIN OUT [FILES_OF_A_KIND [FIRST_SEED]]

Whatever a file holds, the program that reads it ends by itself within 20 s, with an exit code that
it documents, and says what is wrong. A file that breaks this is kept in OUT with the command.
Prints a row for each kind; exits 1 when one was broken."""

import concurrent.futures
import os
import pathlib
import random
import resource
import shutil
import signal
import socket
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
from hapnet import Emulator, Peer  # noqa: E402

TIME_MAX_S = 20
MEMORY_MAX = 4 << 30
TOKENS = [b"0", b"-1", b"1e309", b"nan", b"null", b"{}", b"[]", b'""', b"true", b"\n", b"\x00",
          b"\xff", b"=", b"[[", b"]]", b"9223372036854775808", b"18446744073709551616", b"1e-320",
          b"ms", b"%", b",", b"#", b"\xe2\x80\xae", b"../../x", b"/dev/stdin"]


def changed(data: bytes, other: bytes, draw: random.Random) -> bytes:
    """One to six changes: bytes, digits, cuts, repeats, tokens, parts of another file."""
    out = bytearray(data)
    for _ in range(draw.randint(1, 6)):
        if not out:
            return bytes(out)
        at = draw.randrange(len(out))
        length = draw.randint(1, 1 + len(out) // draw.choice((4, 40, 400)))
        what = draw.randrange(7)
        if what == 0:
            out[at] = draw.randrange(256)
        elif what == 1:
            out[at:at + 1] = str(draw.randrange(10)).encode()
        elif what == 2:
            del out[at:at + length]
        elif what == 3:
            out[at:at] = out[at:at + length]
        elif what == 4:
            out[at:at + draw.randrange(4)] = draw.choice(TOKENS)
        elif what == 5:
            begin = draw.randrange(max(1, len(other)))
            out[at:at] = other[begin:begin + length]
        else:
            lines = bytes(out).split(b"\n")
            del lines[draw.randrange(len(lines))]
            out = bytearray(b"\n".join(lines))
    return bytes(out)


class Kind:
    """Samples of one kind of file, and how a program reads one."""

    def __init__(self, name, samples, command, exits=(0, 1, 2, 3), place="file"):
        self.name = name
        self.samples = samples
        self.command = command  # folder -> words; the file is folder/place
        self.exits = exits
        self.place = place


def limit_memory():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY_MAX, MEMORY_MAX))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def judge(kind: Kind, folder: pathlib.Path) -> str:
    """What is wrong with how the program took the file; "" when nothing is."""
    try:
        done = subprocess.run(kind.command(folder), cwd=folder, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=TIME_MAX_S,
                              preexec_fn=limit_memory, check=False)
    except subprocess.TimeoutExpired:
        return f"it did not end within {TIME_MAX_S} s"
    if done.returncode < 0:
        return f"ended by {signal.Signals(-done.returncode).name}: {done.stderr[-300:]!r}"
    if done.returncode not in kind.exits:
        return f"exit code {done.returncode}: {done.stderr[-300:]!r}"
    if done.returncode != 0 and not done.stderr.strip() and not done.stdout.strip():
        return f"exit code {done.returncode}, and not a word"
    if b"terminate called" in done.stderr or b"ERROR: AddressSanitizer" in done.stderr:
        return done.stderr[-300:].decode(errors="replace")
    return ""


def soak(kind: Kind, count: int, first: int, out: pathlib.Path) -> int:
    """Gives how many files were broken."""
    contents = [sample.read_bytes() for sample in kind.samples]

    def one(seed: int) -> bool:
        draw = random.Random(f"{kind.name} {seed}")
        data = changed(draw.choice(contents), draw.choice(contents), draw)
        folder = out / f"{kind.name}-{seed}"
        kind_folder = getattr(kind, "folder", None)
        if kind_folder:
            shutil.copytree(kind_folder, folder)
        else:
            folder.mkdir()
        (folder / kind.place).write_bytes(data)
        os.chmod(folder / kind.place, 0o600)
        trouble = judge(kind, folder)
        if trouble:
            words = " ".join(map(str, kind.command(folder)))
            print(f"  {kind.name}, seed {seed}: {trouble}\n    {words}", flush=True)
            return False
        shutil.rmtree(folder, ignore_errors=True)
        return True

    begin = time.monotonic()
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        fine = sum(pool.map(one, range(first, first + count)))
    print(f"  {kind.name:12} {count} files, {count - fine} broken, "
          f"{time.monotonic() - begin:.0f} s", flush=True)
    return count - fine


def make_run(folder: pathlib.Path):
    """Statistics, fates and a capture of a short run of the emulator."""
    emulator = Emulator(delay="5ms", loss="10%", duration="1s", stats=folder / "stats.json",
                        fates=folder / "fates.csv", pcap=folder / "run.pcapng").start()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
        for number in range(200):
            sender.sendto(number.to_bytes(4, "little") * 8, emulator.address_a)
            time.sleep(0.002)
    emulator.join()


def make_records(folder: pathlib.Path):
    """Records of both peers of a short session on this machine."""
    with Emulator() as emulator:
        peers = [Peer(id=i + 1, remote=emulator.ready[side], duration="4s",
                      record=folder / f"{i + 1}.rec").start() for i, side in enumerate("ab")]
        for peer in peers:
            peer.join()


def kinds(source: pathlib.Path, bin_dir: pathlib.Path, made: pathlib.Path):
    """All kinds, with samples that were made where the source has none."""
    emulator, lab, peer = (bin_dir / f"hapnet-{name}" for name in ("emulator", "lab", "peer"))

    def quiet(*words, **options):
        subprocess.run(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True,
                       **options)

    made.mkdir(parents=True)
    make_run(made)
    make_records(made)
    (made / "delays.csv").write_text("time,delay\n0s,10ms\n100ms,20ms\n1s,12.5ms\n")
    (made / "losses.txt").write_text("0 1 0 0 1 # lost\n0110\n")
    (made / "pings.txt").write_text("".join(
        f"64 bytes from 10.0.0.2: icmp_seq={i} ttl=64 time={20 + i % 7}.{i % 10} ms\n"
        for i in range(1, 300) if i % 9) + "\n299 packets transmitted, 266 received\n")
    for name in ("dead-reckoning", "wave"):
        text = subprocess.run([peer, "--print-algorithm", name], check=True, capture_output=True)
        (made / f"{name}.toml").write_bytes(text.stdout)
    quiet(peer, "keygen", "--peers", "2", "--out", made / "keys")
    (made / "small.toml").write_text(
        'kind = "limits"\nseeds = 2\nduration = "5s"\ntasks = ["P1"]\nalgorithms = ["base"]\n'
        'limit.delay = { to = "40ms", step = "40ms", resolution = "40ms" }\n')
    quiet(lab, "plan", made / "small.toml", "--out", made / "plan")
    quiet(lab, "run", made / "plan", "--shard", "0/1")
    shards = [one for one in (made / "plan").rglob("*")
              if one.is_file() and one.name != "plan.json"]

    def files(folder, pattern="*.toml"):
        return sorted((source / folder).glob(pattern))

    yield Kind("profile", files("scripts/profiles"), lambda d: [emulator, "check", d / "file.toml"],
               place="file.toml")
    yield Kind("statistics", [made / "stats.json"],
               lambda d: [emulator, "verify", d / "file.json"], place="file.json")
    yield Kind("fates", [made / "fates.csv"],
               lambda d: [emulator, "verify", d / "file.csv", "--profile", "wifi-busy",
                          "--seed", "1", "--rate", "500"], place="file.csv")
    yield Kind("capture", [made / "run.pcapng"], lambda d: [emulator, "learn", d / "run.pcapng"],
               place="run.pcapng")
    yield Kind("measurement", [made / "pings.txt"], lambda d: [emulator, "learn", d / "pings.txt"],
               place="pings.txt")
    for name, law in (("delays.csv", "delay"), ("losses.txt", "loss")):
        yield Kind(f"trace-{law}", [made / name],
                   lambda d, name=name, law=law: [
                       emulator, "predict", "--set",
                       f'up.{law}={{ law = "trace", file = "{d / name}" }}', "--packets", "100"],
                   place=name)
    yield Kind("scene", files("scripts/scenes"), lambda d: [lab, "explain", d / "file.toml"],
               place="file.toml")
    yield Kind("experiment", files("scripts/experiments"),
               lambda d: [lab, "plan", d / "file.toml", "--out", d / "out"], place="file.toml")
    plan = Kind("plan", [made / "plan" / "plan.json"], lambda d: [lab, "merge", d],
                place="plan.json")
    plan.folder = made / "plan"
    yield plan
    for shard in shards:
        place = str(shard.relative_to(made / "plan"))
        kind = Kind(f"shard{shard.suffix or '-' + shard.name}", [shard],
                    lambda d: [lab, "merge", d], place=place)
        kind.folder = made / "plan"
        yield kind
    yield Kind("record", [made / "1.rec"],
               lambda d: [lab, "analyse", d / "file.rec", made / "2.rec"], place="file.rec")
    yield Kind("replay", [made / "1.rec"], lambda d: [lab, "replay", d / "file.rec"],
               place="file.rec")
    yield Kind("key", sorted((made / "keys").glob("*.key")),
               lambda d: [peer, "key", "show", d / "file.key"], place="file.key")
    yield Kind("algorithm", [made / "dead-reckoning.toml", made / "wave.toml"],
               lambda d: [peer, "--print-algorithm", d / "file.toml"], place="file.toml")


def main() -> int:
    source, bin_dir, out = (pathlib.Path(word).resolve() for word in sys.argv[1:4])
    os.environ["HAPNET_BIN"] = str(bin_dir)
    count = int(sys.argv[4]) if len(sys.argv) > 4 else 2000
    first = int(sys.argv[5]) if len(sys.argv) > 5 else 0
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    broken = sum(soak(kind, count, first, out) for kind in kinds(source, bin_dir, out / "made"))
    print(f"  {broken} broken in all")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
