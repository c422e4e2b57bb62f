#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# A session with the copy of base in C takes at most 5 % more instructions than with base itself.
# VALGRIND SPIN_SESSION BASE_SO
set -euo pipefail
valgrind=$1 spin=$2 base=$3
[[ -x $valgrind ]] || { echo "valgrind is not installed: nothing was counted" && exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# count ALGORITHM SECONDS: the instructions of the whole run.
count() {
    "$valgrind" --tool=callgrind --callgrind-out-file="$folder/out" "$spin" "$1" 2 "$2" \
        >"$folder/log" 2>&1 || { cat "$folder/log" >&2 && exit 1; }
    sed -n 's/^summary: //p' "$folder/out"
}

# per_second ALGORITHM: start and end cancel.
per_second() {
    local short long
    short=$(count "$1" 6)
    long=$(count "$1" 10)
    echo $(((long - short) / 4))
}

own=$(per_second base)
foreign=$(per_second "$base")
echo "a second of a session: $own instructions with base, $foreign with its copy in C"
((own > 1000000)) || { echo "too few: nothing was played" && exit 1; }
((100 * foreign <= 105 * own))
