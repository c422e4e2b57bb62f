# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""A figure that is described once is in every output: docs/design/add-a-figure.md is true.

add_a_figure_test.py REPOSITORY BIN_DIR
"""

import json
import re
import socket
import subprocess
import sys
import tempfile
from pathlib import Path

repository, programs = Path(sys.argv[1]), Path(sys.argv[2])
emulator, ctl = programs / "hapnet-emulator", programs / "hapnet-ctl"
page = (repository / "docs/design/add-a-figure.md").read_text()


def printed(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


# The code of the page is put into the three files that the page names.
files = re.findall(r"^## \d\. .*`(.*)`$", page, re.MULTILINE)
assert len(files) == 3, files
sections = re.split(r"^## ", page, flags=re.MULTILINE)[1:4]
for file, section in zip(files, sections):
    blocks = re.findall(r"```cpp\n(.*?)```", section, re.DOTALL)
    assert blocks, file
    for block in blocks:
        assert block in (repository / file).read_text(), f"{file} does not have\n{block}"

# Each output of a run has the figure.
with tempfile.TemporaryDirectory() as place:
    stats, fates, control = (str(Path(place) / name) for name in ("s.json", "f.csv", "e.sock"))
    run = subprocess.Popen(
        [emulator, "--listen-a", "127.0.0.1:0", "--listen-b", "127.0.0.1:0", "--stats", stats,
         "--fates", fates, "--control", control, "--set",
         'up.reorder={ share = "100%", displacement = 3 }'],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        ready = dict(re.findall(r"(\S+)=(\S+)", run.stdout.readline()))
        host, port = ready["a"].rsplit(":", 1)
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as a, \
                socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as b:
            b_host, b_port = ready["b"].rsplit(":", 1)
            b.sendto(b"I am B", (b_host, int(b_port)))
            printed(ctl, control, "wait", "--until", "down.received>0", "--timeout", "20s")
            for _ in range(5):
                a.sendto(b"datagram", (host, int(port)))
            printed(ctl, control, "wait", "--until", "up.displaced==5", "--timeout", "20s")
        metrics = printed(ctl, control, "metrics")
        assert re.search(r'^hapnet_emulator_displaced_total\{direction="up"\} 5$', metrics, re.M), \
            metrics
        csv = printed(ctl, control, "stats", "--csv").splitlines()
        assert csv[0] == "key,value" and "up.displaced,5" in csv, csv
        watch = subprocess.Popen([ctl, control, "watch", "--frames"], stdout=subprocess.PIPE,
                                 text=True)
        frame = json.loads(watch.stdout.readline())
        watch.kill()
        watch.communicate()
        assert frame["paths"][0]["up"]["displaced"] == 0  # since the watch began
        printed(ctl, control, "stop")
        _, words = run.communicate(timeout=30)
    finally:
        run.kill()
    assert re.search(r"^up +\(A to B\): 5 received, .*\b5 displaced\b", words, re.M), words
    assert json.loads(Path(stats).read_text())["up"]["displaced"] == 5
    html = str(Path(place) / "page.html")
    printed(emulator, "report", stats, "--out", html)
    assert '"displaced"' in Path(html).read_text()

for schema in ("statistics", "frame"):
    text = printed(emulator, "schema", schema)
    assert '"displaced": {' in text and "moved behind later ones" in text, schema
for docs in ("statistics.md", "live.md"):
    assert "| `displaced` |" in (repository / "docs/formats" / docs).read_text(), docs
