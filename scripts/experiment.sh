#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Carries out experiments in virtual time, one after the other, and writes one report of them:
# table1.sh, fig6a.sh, ... are this script with a name.
set -euo pipefail

usage="usage: scripts/experiment.sh NAME[,NAME...] [--out DIR] [--quick] [--seeds N] [--jobs N]
                             [--set KEY=VALUE] [--conventions N] [--real-time]
Installs what is missing, builds hapnet-lab, carries out the experiments of these names
(scripts/experiments/NAME.toml, docs/use/experiments.md) and writes CSV, manifest.json and
report.html to DIR (results/NAME-<time> when not given; several: one folder each in it). Run again
with the same --out after an interruption: nothing is computed twice. --quick is rougher, with fewer
seeds; --jobs is the number of threads (all processors) and does not change the results;
--conventions searches fig6a's and fig6b's limits again with other filters and hands, N seeds
each; --real-time
plays the sessions in real time, too (scripts/real-time.sh): of table1 its cells of P1, 30 s each,
of others every session, into DIR/daemons. Exits 0 when done, 1 when stopped, 2 for an unknown name
or argument, 3 when something that it needs cannot be installed."

refuse() {
    echo "experiment: $1"$'\n'"$usage" >&2
    exit 2
}

names=() out='' options=() daemons=() real_time='' quick=() conventions='' changed=no
while (($# > 0)); do
    case $1 in
    --quick) options+=(--quick) quick=(--quick) && shift ;;
    --real-time) real_time=yes && shift ;;
    --out)
        (($# > 1)) || refuse "--out: which directory?"
        out=$(realpath -m "$2") && shift 2
        ;;
    --conventions)
        (($# > 1)) || refuse "$1: which value?"
        conventions=$2 && shift 2
        ;;
    --seeds | --jobs | --set)
        (($# > 1)) || refuse "$1: which value?"
        options+=("$1" "$2")
        [[ $1 == --jobs ]] || daemons+=("$1" "$2") changed=yes
        shift 2
        ;;
    -h | --help) echo "$usage" && exit 0 ;;
    -*) refuse "unknown argument '$1'" ;;
    *) IFS=, read -r -a names <<<"$1" && shift ;;
    esac
done
((${#names[@]} > 0)) || refuse "which experiment?"

cd "$(dirname "${BASH_SOURCE[0]}")/.."
time=$(date -u +%Y%m%dT%H%M%SZ)
title=${names[0]}
((${#names[@]} == 1)) || title=reproduce
out=${out:-$PWD/results/$title-$time}
lab=build/release/bin/hapnet-lab

build() {
    scripts/setup.sh
    [[ -e build/release/build.ninja ]] || cmake --preset release -DHAPNET_TESTS=OFF
    local quiet=()
    [[ ! -x $lab ]] || quiet=(-- --quiet)
    cmake --build --preset release --target hapnet-lab "${quiet[@]}"
}

build >&2
for name in "${names[@]}"; do
    folder=$out
    ((${#names[@]} == 1)) || folder=$out/$name
    more=()
    [[ -z $conventions || $name != fig6[ab] ]] || more=(--set "convention.seeds=$conventions")
    "$lab" run "$name" "${options[@]}" "${more[@]}" --out "$folder"
    # Compares the limits of these seeds with the published ones, if the experiment is unchanged.
    if [[ $name == fig6[ab] && -z ${quick[*]} && $changed == no ]] &&
        command -v python3 >/dev/null; then
        python3 scripts/limits_pool.py agree "$folder"
    fi
    if [[ -n $real_time && $name == table1 ]]; then
        scripts/real-time.sh --out "$folder" "${quick[@]}"
    elif [[ -n $real_time ]]; then
        scripts/real-time.sh "$name" --out "$folder/daemons" "${quick[@]}" "${daemons[@]}"
    fi
done
"$lab" report "$out"
