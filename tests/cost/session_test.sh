#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# A tick of a session in virtual time, of one player with all that belongs to it, takes no more than
# MOST instructions, if that is not 0.
# VALGRIND PROGRAM ALGORITHM PLAYERS MOST
set -euo pipefail
valgrind=$1 program=$2 algorithm=$3 players=$4 most=$5
[[ -x $valgrind ]] || { echo "valgrind is not installed: nothing was counted" && exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# count SECONDS: the instructions of a whole session.
count() {
    "$valgrind" --tool=callgrind --callgrind-out-file="$folder/out" \
        "$program" "$algorithm" "$players" "$1" >"$folder/log" 2>&1 ||
        { cat "$folder/log" >&2 && exit 1; }
    sed -n 's/^summary: //p' "$folder/out"
}

# 8 s longer, all of it hands on: start and end cancel.
short=$(count 8)
long=$(count 16)
each=$(((long - short) / (8000 * players)))
echo "$algorithm, $players players: $each instructions a tick of a player"
((each > 1000)) || { echo "too few: nothing was done" && exit 1; }
((most == 0 || each <= most)) || { echo "more than $most" && exit 1; }
