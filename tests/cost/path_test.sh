#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# A datagram takes no more than MOST instructions in the emulator's core, if that is not 0, as long
# as nobody watches; what a watch adds is said.
# VALGRIND SPIN_PATH MOST
set -euo pipefail
valgrind=$1 spin=$2 most=$3
[[ -x $valgrind ]] || { echo "valgrind is not installed: nothing was counted" && exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# count WATCHED DATAGRAMS: the instructions of the whole run.
count() {
    "$valgrind" --tool=callgrind --callgrind-out-file="$folder/out" "$spin" "$1" "$2" \
        >"$folder/log" 2>&1 || { cat "$folder/log" >&2 && exit 1; }
    sed -n 's/^summary: //p' "$folder/out"
}

# each WATCHED: of the datagrams after the first 2000; start and end cancel.
each() {
    local short long
    short=$(count "$1" 2000)
    long=$(count "$1" 12000)
    echo $(((long - short) / 10000))
}

unwatched=$(each unwatched)
watched=$(each watched)
echo "a datagram through a path of 160 ms: $unwatched instructions, $watched when watched"
((unwatched > 100)) || { echo "too few: nothing was done" && exit 1; }
((watched > unwatched)) || { echo "a watch counts nothing" && exit 1; }
((most == 0 || unwatched <= most)) || { echo "more than $most" && exit 1; }
