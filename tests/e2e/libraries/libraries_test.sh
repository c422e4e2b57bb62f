#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# The libraries as a stranger gets them: installed and used as docs/use/libraries.md says, found by
# CMake and by pkg-config where they were moved to, and used by the programs of examples/, which do
# what they say.
#   libraries_test.sh REPOSITORY BUILD CXX
set -euo pipefail
repository=$1 build=$2 cxx=$3
work=$(mktemp -d)
peers=()
cleanup() {
    ((${#peers[@]} == 0)) || kill "${peers[@]}" 2>/dev/null || true
    rm -rf "$work"
}
trap cleanup EXIT

fail() {
    echo "libraries_test: $1" >&2
    exit 1
}

# The page's own commands, with warnings as errors. Other processes here need real time.
export HAPNET_PAGE_FOLDER=$work/page HAPNET_PAGE_SECONDS=400 PYTHONDONTWRITEBYTECODE=1
CXX=$cxx CXXFLAGS="-Wall -Wextra -Werror" chrt --idle 0 "$repository/tests/e2e/readme_test.sh" \
    "$repository/docs/use/libraries.md" "$build/bin" 5
mv "$work/page/build/prefix" "$work/prefix" # an installed tree may be moved
prefix=$work/prefix
cmake -S "$repository/examples" -B "$work/build" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_CXX_COMPILER="$cxx" >"$work/configure.log" 2>&1 || fail "$(cat "$work/configure.log")"

# Each header finds its includes, and each folder is used.
cd "$prefix/include/hapnet"
while IFS=: read -r header line; do
    included=${line#*\"}
    included=${included%%\"*}
    [[ -f $included ]] || fail "$header includes $included, which is not installed"
done < <(grep -rE '^#include "' .)
cd - >/dev/null

examples=$work/page/build/examples
run() { "$examples/example_$1" "${@:2}"; }

scene=$(run scene)
grep -q "^1000 ms  cube at  *[0-9]" <<<"$scene" || fail "scene: $scene"
emulator=$(run emulator)
arrived="58[78][0-9][0-9] arrived, delay 35.0 to 45.0 ms"
grep -Eq "^up  *60000 sent, $arrived, median (39.9|40.[01]) ms" <<<"$emulator" ||
    fail "emulator: $emulator"
grep -q "^down  *60000 sent, 60000 arrived, delay 35.0 to 85.0 ms" <<<"$emulator" ||
    fail "emulator: $emulator"
[[ $(run emulator) == "$emulator" ]] || fail "the same seed gave something else"
# A library outside of the system's folders needs a path at run time.
libdir=$(dirname "$(find "$prefix" -name libhapnet-link.so)")
link=$(LD_LIBRARY_PATH=$libdir run link)
grep -q "^31 of 1000 lost" <<<"$link" || fail "link: $link" # those of its seed
session=$(run session)
grep -q "^base: [0-9]* ticks" <<<"$session" || fail "session: $session"

# The peer of the examples plays with the daemon. Ports of its own: tests have one loopback each.
timeout 40 "$examples/example_peer" 127.0.0.1:7101 127.0.0.1:7102 >"$work/peer.log" 2>&1 &
peers+=($!)
"$build/bin/hapnet-peer" --id 2 --listen 127.0.0.1:7102 --remote 127.0.0.1:7101 --task T1 \
    --duration 4s --stats "$work/stats.json" >"$work/daemon.log" 2>&1 ||
    fail "$(cat "$work/daemon.log")"
wait "${peers[0]}" || fail "the example's peer: $(cat "$work/peer.log")"
peers=()
grep -Eq '^[1-9][0-9]{2,} states heard' "$work/peer.log" || fail "$(cat "$work/peer.log")"

# pkg-config gives the same result.
if command -v pkg-config >/dev/null; then
    pc=$(dirname "$(find "$prefix" -name hapnet-lab.pc)")
    for example in scene:hapnet-scene session:hapnet-lab; do
        # shellcheck disable=SC2046 # words of a command line
        chrt --idle 0 "$cxx" $(PKG_CONFIG_PATH=$pc pkg-config --cflags "${example#*:}") \
            "$repository/examples/${example%:*}/${example%:*}.cpp" -o "$work/by_pkg_config" \
            $(PKG_CONFIG_PATH=$pc pkg-config --libs "${example#*:}") >"$work/pc.log" 2>&1 ||
            fail "pkg-config: $(cat "$work/pc.log")"
        [[ $("$work/by_pkg_config") == "$(run "${example%:*}")" ]] || fail "$example differs"
    done
    # shellcheck disable=SC2046
    cc -std=c11 -Wall -Wextra -Wpedantic -Werror \
        $(PKG_CONFIG_PATH=$pc pkg-config --cflags hapnet-link) "$repository/examples/link/link.c" \
        -o "$work/link_in_c" $(PKG_CONFIG_PATH=$pc pkg-config --libs hapnet-link) ||
        fail "examples/link/link.c is no C for pkg-config's words"
    [[ $(LD_LIBRARY_PATH=$libdir "$work/link_in_c") == "$link" ]] || fail "link differs"
fi

# Another version, and an unknown component, are refused with a message.
for wrong in "9.9 REQUIRED" "REQUIRED COMPONENTS porto"; do
    mkdir -p "$work/wrong"
    printf 'cmake_minimum_required(VERSION 3.25)\nproject(wrong CXX)\nfind_package(hapnet %s)\n' \
        "$wrong" >"$work/wrong/CMakeLists.txt"
    ! cmake -S "$work/wrong" -B "$work/wrong/build" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" \
        -DCMAKE_CXX_COMPILER="$cxx" >"$work/wrong.log" 2>&1 || fail "found hapnet $wrong"
    rm -rf "$work/wrong"
done
grep -q "there is no porto" "$work/wrong.log" || fail "$(cat "$work/wrong.log")"
echo "libraries_test: installed, found, built and run"
