#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Runs tests repeatedly, to find tests that fail only once in twenty runs.
set -euo pipefail

usage="usage: scripts/repeat_tests.sh --out DIR [--runs N] [--label REGEX] [--as USER]
Runs the tests of build/release whose label matches REGEX (clock when not given) N times (20), and
writes DIR/runs.csv, a row for each run, and DIR/run-K.log, what each test of run K said. Runs that
have a row are not repeated, so after Ctrl-C the same command goes on where it was. --as USER, as
root: that user runs them, and owns the folder build afterwards. Builds nothing: scripts/test.sh
does. Exits 0 when no test failed in any run, 1 when one did, 2 for an unknown argument."

refuse() {
    echo "repeat_tests: $1"$'\n'"$usage" >&2
    exit 2
}
out='' runs=20 label=clock user=''
while (($# > 0)); do
    case $1 in
    --out | --runs | --label | --as)
        (($# > 1)) || refuse "$1: which value?"
        case $1 in
        --out) out=$(realpath -m "$2") ;;
        --runs) runs=$2 ;;
        --label) label=$2 ;;
        --as) user=$2 ;;
        esac
        shift 2
        ;;
    -h | --help) echo "$usage" && exit 0 ;;
    *) refuse "unknown argument '$1'" ;;
    esac
done
[[ -n $out ]] || refuse "--out is required"
[[ $runs =~ ^[1-9][0-9]*$ ]] || refuse "--runs: a whole number, 1 or more"
[[ -z $user || $EUID == 0 ]] || refuse "--as needs root"
cd "$(dirname "${BASH_SOURCE[0]}")/.."
[[ -e build/release/CTestTestfile.cmake ]] ||
    refuse "build/release has no tests: run scripts/test.sh"
as_user=()
if [[ -n $user ]]; then
    as_user=(runuser -u "$user" --)
    chown -R "$user:" build
fi

mkdir -p "$out"
rows=$out/runs.csv
[[ -s $rows ]] || echo "run,passed,failed,skipped,seconds" >"$rows"
any_failed=0
for ((run = 1; run <= runs; run++)); do
    if ! grep -q "^$run," "$rows"; then
        begin=$SECONDS
        "${as_user[@]}" ctest --test-dir build/release --parallel $((2 * $(nproc))) \
           --no-tests=error \
            --label-regex "^($label)\$" --output-on-failure >"$out/run-$run.console" 2>&1 || true
        grep -q '% tests passed' "$out/run-$run.console" || {
            cat "$out/run-$run.console" >&2
            exit 1
        }
        cp build/release/Testing/Temporary/LastTest.log "$out/run-$run.log"
        awk -v run="$run" -v seconds=$((SECONDS - begin)) '
            /% tests passed, .* tests? failed out of/ { failed = $4; all = $NF }
            /^[ \t]*[0-9]+ - .*\(Skipped\)$/ { skipped++ }
            END { printf "%d,%d,%d,%d,%d\n", run, all - failed - skipped, failed, skipped, seconds }
        ' "$out/run-$run.console" >>"$rows"
    fi
    row=$(grep "^$run," "$rows")
    echo "run $row"
    IFS=, read -r _ _ failed _ <<<"$row"
    ((failed == 0)) || {
        any_failed=1
        sed -n '/^The following tests FAILED:/,/^$/p' "$out/run-$run.console"
    }
done
exit $any_failed
