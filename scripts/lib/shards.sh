# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# shellcheck shell=bash
# What the scripts that play the shards of a plan have in common. Theirs: usage, the name of the
# script in `name`, and own_option, which is given the arguments from an option on that is not
# common, sets `taken` to how many of them belong to it, and fails for what it does not know.

refuse() {
    # shellcheck disable=SC2154 # the script's
    echo "$name: $1"$'\n'"$usage" >&2
    exit 2
}

directory=
shards=
lab=
missing=()
rest=()

# read_plan ARGUMENT...: sets directory (absolute), shards, lab (the program), and rest: what follows
# --. Refuses what is wrong.
read_plan() {
    local taken
    while (($# > 0)); do
        case $1 in
        --shards)
            (($# > 1)) || refuse "--shards: a number of shards"
            shards=$2 && shift 2
            ;;
        -h | --help) echo "$usage" && exit 0 ;;
        --) shift && break ;;
        -*)
            taken=0
            own_option "$@" || refuse "unknown argument '$1'"
            (($# >= taken)) || refuse "$1: needs a value"
            shift "$taken"
            ;;
        *) directory=$1 && shift ;;
        esac
    done
    rest=("$@")
    [[ -f $directory/plan.json ]] || refuse "'$directory' has no plan.json"
    [[ $shards =~ ^[1-9][0-9]*$ ]] || refuse "--shards: a number of shards"
    directory=$(realpath "$directory")
    lab=${HAPNET_BIN:+$(realpath "$HAPNET_BIN")/}hapnet-lab
    lab=$(command -v "$lab") || refuse "there is no $lab"
}

# find_missing: sets missing to the shards of the plan that have not ended.
find_missing() {
    local shard
    for ((shard = 0; shard < shards; ++shard)); do
        [[ -e $directory/shards/$shard-of-$shards.done ]] || missing+=("$shard")
    done
}
