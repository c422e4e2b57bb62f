# shellcheck shell=bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# To be sourced by the tests of the wheel, which define fail().

# try_wheel WHEEL PROGRAMS VENV: installs it into a new environment, without a network, and has it
# drive the emulator in the folder PROGRAMS.
try_wheel() {
    rm -rf "$3"
    /usr/bin/python3 -m venv --without-pip "$3"
    /usr/bin/python3 -m pip --quiet --disable-pip-version-check --python "$3/bin/python" install \
        --no-index --no-cache-dir "$1" || fail "${1##*/} cannot be installed"
    "$3/bin/hapnet-study" --version || fail "${1##*/} brings no hapnet-study"
    HAPNET_BIN=$2 "$3/bin/python" -I - "$3" <<'PYTHON' || fail "${1##*/} does not drive the emulator"
import sys

import hapnet
import hapnet.wire

assert hapnet.__file__.startswith(sys.argv[1]), hapnet.__file__
with hapnet.Emulator(delay="5ms") as network:
    print("the wheel of", hapnet.__version__, "drives", network.address_a, network.stats()["valid"])
PYTHON
}
