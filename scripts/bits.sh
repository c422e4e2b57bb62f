#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Shows whether a scene's bits depend on the compiler: runs every play of tests/bits for 20 s, built
# by GCC and Clang at -O0, -O2 and -O3 -march=native, and compares the hashes.
set -euo pipefail
cd "$(dirname "$0")/.."

usage="usage: scripts/bits.sh
Builds six times and compares; takes some minutes. Exits 0 when all bits are equal, 1 when not."
if (($# > 0)); then
    [[ $1 == -h || $1 == --help ]] && echo "$usage" && exit 0
    echo "bits: unknown argument '$1'"$'\n'"$usage" >&2
    exit 2
fi

scripts/setup.sh --test
expected=
failed=0
for compiler in g++ clang++-14; do
    for level in "-O0" "-O2" "-O3 -march=native"; do
        folder="build/bits/$compiler${level// /}"
        cmake -S . -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Bits -DCMAKE_CXX_COMPILER="$compiler" \
            -DCMAKE_CXX_FLAGS_BITS="$level" -DHAPNET_TEST_KINDS=bits >/dev/null
        cmake --build "$folder" --target scene_bits >/dev/null
        hashes=$("$folder/bin/scene_bits") || failed=1
        expected=${expected:-$hashes}
        verdict=equal
        [[ $hashes == "$expected" ]] || verdict=OTHER failed=1
        printf '%-36s %s\n' "$compiler $level" "$verdict"
        [[ $verdict == equal ]] || diff <(echo "$expected") <(echo "$hashes") || true
    done
done
echo "$expected"
exit "$failed"
