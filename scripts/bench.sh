#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Measures one part of the project against its baselines.
set -euo pipefail

usage="usage: scripts/bench.sh emulator|scene|lab|device|secure [--quick] [--json FILE]
       scripts/bench.sh emulator --busy [--quick] [--json FILE]
       scripts/bench.sh web [--quick] [--json FILE] [--page]
       scripts/bench.sh scene [... the same ...] [--csv FILE] [--markdown FILE]
       scripts/bench.sh lab|emulator [... the same ...] [--csv FILE]
Installs what is missing, builds the release preset's benchmark, and runs it: a table on stdout, and
the same numbers in FILE; of the scene --csv has the points of its work-precision diagram, of the
lab error against run time, of the emulator the distributions of its errors; scripts/plot.py draws
them. Of the emulator --busy is its lateness beside a busy process on each processor; of the web
what ten who watch cost the daemons, or with --page what the page costs in Chromium without a
graphics card. --quick ends within a minute of measuring; in full the emulator's takes 5 minutes,
with --busy 15. Run the emulator's as root, or where SCHED_FIFO is allowed, to
measure real-time scheduling too, and the lab's so that nothing else counts. Exits 0 when it has
measured, also when a target was missed; 2 for an unknown subject or argument."

refuse() {
    echo "bench: $1"$'\n'"$usage" >&2
    exit 2
}

(($# > 0)) || refuse "which subject?"
subject=$1
shift
case $subject in
-h | --help) echo "$usage" && exit 0 ;;
emulator | scene | lab | device | secure | web) ;;
*) refuse "unknown subject '$subject'" ;;
esac

arguments=()
web_bench=(python3 tests/bench/web/disturbance.py)
while (($# > 0)); do
    case $1 in
    --quick) arguments+=(--quick) && shift ;;
    --busy)
        [[ $subject == emulator ]] || refuse "--busy is for the emulator"
        arguments+=(--busy) && shift
        ;;
    --page)
        [[ $subject == web ]] || refuse "--page is for web"
        web_bench=(node tests/bench/web/page.mjs) && shift
        ;;
    --csv | --json | --markdown)
        (($# > 1)) || refuse "$1: which file?"
        arguments+=("$1" "$(realpath -m "$2")") && shift 2
        ;;
    -h | --help) echo "$usage" && exit 0 ;;
    *) refuse "unknown argument '$1'" ;;
    esac
done

cd "$(dirname "${BASH_SOURCE[0]}")/.."
targets=("bench_$subject")
[[ $subject != web ]] || targets=(hapnet-web hapnet-emulator hapnet-peer hapnet-lab)
{
    scripts/setup.sh --test
    cmake --preset release
    cmake --build --preset release --target "${targets[@]}"
} >&2
if [[ $subject == web ]]; then
    export HAPNET_BIN=$PWD/build/release/bin PYTHONDONTWRITEBYTECODE=1
    if [[ ${web_bench[0]} == node ]]; then
        scripts/setup.sh --web >&2
        (cd tests/web && npm ci --ignore-scripts --no-audit --no-fund) >&2
    fi
    exec "${web_bench[@]}" "${arguments[@]}"
fi
exec "build/release/bin/bench_$subject" "${arguments[@]}"
