# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""The services of a compose file, a line each, for compose_test.sh.

compose.py FILE prints NAME|IMAGE|ADDRESS|VOLUMES|LIMITS|COMMAND: the image is called as its
Dockerfile is, the volumes are NAME:PATH, the limits NAME=VALUE. What compose_test.sh does not play
is an error here, so that no line of the file goes untried.
"""

import pathlib
import shlex
import sys

import yaml

known = {"build", "ulimits", "networks", "volumes", "command"}
document = yaml.safe_load(pathlib.Path(sys.argv[1]).read_text())
assert document.keys() == {"services", "networks", "volumes"}, f"unknown: {document.keys()}"
assert len(document["services"]) == 3, f"services: {list(document['services'])}"
used = [volume.split(":")[0] for service in document["services"].values()
        for volume in service.get("volumes", [])]
assert len(used) == len(set(used)), f"services share a volume, and so their keys: {used}"
for name, service in document["services"].items():
    assert service.keys() <= known, f"{name}: unknown: {service.keys() - known}"
    dockerfile = pathlib.Path(service["build"]["dockerfile"])
    (network,) = service["networks"]
    assert network in document["networks"], f"{name}: no such network: {network}"
    volumes = service.get("volumes", [])
    for volume in volumes:
        assert volume.split(":")[0] in document["volumes"], f"{name}: no such volume: {volume}"
    print(name, dockerfile.name.removesuffix(".Dockerfile"),
          service["networks"][network]["ipv4_address"], " ".join(volumes),
          " ".join(f"{limit}={value}" for limit, value in service.get("ulimits", {}).items()),
          " ".join(shlex.split(service["command"])), sep="|")
