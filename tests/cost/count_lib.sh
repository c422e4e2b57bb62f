# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
# shellcheck shell=bash
#
# Sourced by the tests of costs, which have set `valgrind`: counts instructions.
shopt -s inherit_errexit
[[ -x ${valgrind:?} ]] || { echo "valgrind is not installed: nothing was counted" && exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# count PROGRAM [ARGUMENT ...]: the instructions of the whole run.
count() {
    "$valgrind" --tool=callgrind --callgrind-out-file="$folder/out" "$@" >"$folder/log" 2>&1 ||
        { cat "$folder/log" >&2 && exit 1; }
    sed -n 's/^summary: //p' "$folder/out"
}

# each FROM TO PROGRAM [ARGUMENT ...]: the instructions per unit of the last argument, from the
# difference of the runs with FROM and TO, in which start and end cancel.
each() {
    local short long
    short=$(count "${@:3}" "$1")
    long=$(count "${@:3}" "$2")
    echo $(((long - short) / ($2 - $1)))
}
