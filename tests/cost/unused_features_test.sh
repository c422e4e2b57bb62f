#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# A world in which every tick is compiled and a scene that needs one of them costs at most 2 % more
# instructions than that tick alone, and no more than MOST, if that is not 0.
# VALGRIND WORLD ALONE PROFILE MOST
set -euo pipefail
valgrind=$1 world=$2 alone=$3 profile=$4 most=$5
[[ -x $valgrind ]] || { echo "valgrind is not installed: nothing was counted" && exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# count PROGRAM TICKS: the instructions of the whole run.
count() {
    "$valgrind" --tool=callgrind --callgrind-out-file="$folder/out" "$1" "$profile" "$2" \
        >"$folder/log" 2>&1 || { cat "$folder/log" >&2 && exit 1; }
    sed -n 's/^summary: //p' "$folder/out"
}

# per_tick PROGRAM: of the ticks after the first 200; start and end cancel.
per_tick() {
    local short long
    short=$(count "$1" 200)
    long=$(count "$1" 1200)
    echo $(((long - short) / 1000))
}

with=$(per_tick "$world")
without=$(per_tick "$alone")
echo "$profile: $with instructions a tick with every feature compiled in, $without without"
((without > 100)) || { echo "too few: nothing was done" && exit 1; }
((most == 0 || with <= most)) || { echo "more than $most" && exit 1; }
((100 * with <= 102 * without))
