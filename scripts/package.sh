#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Makes packages for Debian 12.
set -euo pipefail

usage="usage: scripts/package.sh --out DIR [--only emulator]
Installs what is missing, builds the programs, and leaves in DIR the packages hapnet-emulator (with
hapnet-ctl and no library of devices) and hapnet (hapnet-peer, hapnet-lab), each with manual pages,
completions for bash, zsh and fish, and a unit of systemd. --only emulator makes the first alone.
Install them with: apt-get install ./DIR/hapnet-emulator_*.deb
Exits 0 when they are there, 1 when something failed, 2 for an unknown argument, 3 when something
that it needs cannot be installed."

refuse() {
    echo "package: $1"$'\n'"$usage" >&2
    exit 2
}

out=
only=
while (($# > 0)); do
    case $1 in
    --out) out=${2:?$usage} && shift 2 ;;
    --only)
        [[ ${2-} == emulator ]] || refuse "--only: emulator"
        only=emulator && shift 2
        ;;
    -h | --help) echo "$usage" && exit 0 ;;
    *) refuse "unknown argument '$1'" ;;
    esac
done
[[ -n $out ]] || refuse "--out is required: where the packages go"
mkdir -p "$out"
out=$(realpath "$out")

cd "$(dirname "${BASH_SOURCE[0]}")/.."
scripts/setup.sh --package
build=build/package${only:+-$only}
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON \
    -DHAPNET_PRECOMPILED=ON -DHAPNET_TESTS=OFF -DHAPNET_PACKAGES=ON -DHAPNET_ONLY="$only"
cmake --build "$build" --parallel "$(nproc)"
rm -rf "$build/packages"
cpack --config "$build/CPackConfig.cmake" -B "$build/packages"
rm -f "$out"/hapnet_*.deb "$out"/hapnet-emulator_*.deb
cp "$build"/packages/*.deb "$out"
printf 'package: %s\n' "$out"/*.deb
