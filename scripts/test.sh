#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Installs what is missing, builds, and runs the tests: docs/design/tests.md says what there is.
set -euo pipefail

usage="usage: scripts/test.sh [--all | KIND]
Installs what is missing, builds the release preset with GCC and runs every test of it: unit,
property, simulation, conformance, bits, cost, benches' self tests, the house's own rules, programs
end to end; and checks the format of the sources and the scripts.
--all also tries each KIND below for some seconds, runs the tests and replays the fuzz corpora with
Clang under AddressSanitizer and UndefinedBehaviorSanitizer (but for the programs themselves and
emulated devices: those are the workflow asan-e2e), and reads the sources with clang-tidy.
KIND runs instead what needs more than a compiler: programs (other people's, which it installs:
curl, dig, iperf, iperf3, mosh, ping, QUIC), ship (packages, made, installed in a bare root and
removed, and images of them; as root), web (the live page in Chromium; left out, with the reason,
where node, npm or chromium is missing), fleet (a plan in shards by GNU parallel, over ssh to this
machine and as an array on a Slurm cluster of one node, which it starts and ends, as root; and a
million sessions).
What each step said is in build/test-logs. Exits 0 when all passed, 1 when something failed, 2 for
an unknown argument, 3 when something that it needs cannot be installed."

refuse() {
    echo "test: $1"$'\n'"$usage" >&2
    exit 2
}

cd "$(dirname "${BASH_SOURCE[0]}")/.."
all=
kind=
(($# <= 1)) || refuse "one argument at most, not $#"
case ${1-} in
'') ;;
--all) all=yes ;;
-h | --help) echo "$usage" && exit 0 ;;
programs | ship | web | fleet) kind=$1 ;;
-*) refuse "unknown argument '$1'" ;;
*) refuse "unknown kind '$1': use web, programs, ship or fleet" ;;
esac

case $kind in
programs) scripts/setup.sh --test --programs ;;
web) scripts/setup.sh --web ;;
ship) scripts/setup.sh --package --ship ;;
fleet) scripts/setup.sh --test --fleet ;;
*) scripts/setup.sh --test ${all:+--package --web} ;;
esac
logs=build/test-logs
rm -rf "$logs"
mkdir -p "$logs"
summary=()
failed=0

# step NAME COMMAND...: runs the command, shows and keeps what it says, and notes how it went.
step() {
    local name=$1 begin=$SECONDS verdict=ok
    shift
    printf '\n== %s: %s\n' "$name" "$*"
    "$@" 2>&1 | tee "$logs/${name// /-}.log" || verdict=FAILED
    summary+=("$(printf '%-6s %4d s  %s' "$verdict" $((SECONDS - begin)) "$name")")
    [[ $verdict == ok ]] || failed=$((failed + 1))
    [[ $verdict == ok ]]
}

check_format() {
    find proto scene emulator ctl device peer lab web examples tests -name '*.[ch]pp' -print0 |
        xargs -0 clang-format-14 --dry-run --Werror
}

check_scripts() {
    find scripts .ci tests -type f \( -name '*.sh' -o -path '.ci/*' \) -print0 | xargs -0 shellcheck
}

# Whether the scripts of our pages parse, where there is a node to say so.
check_pages() {
    ! command -v node >/dev/null || find lab web/page tests/web -name node_modules -prune -o \
        -name '*.*js' -type f -print0 | xargs -0 -n 1 node --check
}

# Reads all but the tests, and compiles nothing: cmake/HapnetTidy.cmake says how.
check_tidy() {
    cmake --preset tidy && cmake --build --preset tidy --parallel "$(nproc)"
}

# With a list of all tests: two that run at a time must not both write it.
build_release() {
    cmake --build --preset release --parallel "$(nproc)" && ctest --preset release --show-only
}

# All that does not wait: see test_release().
run_release_tests() {
    ctest --preset release --parallel "$(nproc)" --label-exclude '^(e2e|conformance)$'
}

build_asan() {
    cmake --preset asan && cmake --build --preset asan --parallel "$(nproc)"
}

# begin NAME FUNCTION: runs it beside what follows, at the lowest priority there is: tests wait for
# much of their time.
declare -A running=()
begin() {
    begin_with "chrt --idle 0" "$@"
}

# begin_with "COMMAND..." NAME FUNCTION: runs it by that command beside what follows.
begin_with() {
    local command
    read -ra command <<<"$1"
    echo "$2: begins beside what follows"
    export -f "${3?}"
    "${command[@]}" bash -euo pipefail -c "$3" >"$logs/$2.begun.log" 2>&1 &
    running[$2]=$!
}

# finish NAME: waits for what begin() began, and is the step of it.
finish() {
    begun_exit=0
    wait "${running[$1]}" || begun_exit=$?
    step "$1" show_begun "$1"
}
show_begun() {
    local shown=3
    [[ $1 != *-tests && $begun_exit == 0 ]] || shown=+1
    tail -n "$shown" "$logs/$1.begun.log"
    [[ $begun_exit == 0 ]]
}

# The tests end to end wait for most of their time, so all but the programs that they start is built
# beside them. ctest reads their folder alone: in the others there may be half a program then. The
# other tests wait for nothing but those of the devices, and run beside them.
test_release() {
    step "release configure" cmake --preset release &&
        step "release programs" cmake --build --preset release --parallel "$(nproc)" \
            --target end_to_end || return
    begin release-build build_release
    step "release e2e" ctest --test-dir build/release/tests/e2e --parallel $((2 * $(nproc))) \
        --output-on-failure || true
    finish release-build || return
    [[ -z $all ]] || begin asan-build build_asan
    begin_with "nice -n 19" release-tests run_release_tests
    # The emulated devices keep real time, and wait for most of it. One that a busy machine kept
    # waiting may try once more.
    step "release conformance" ctest --test-dir build/release/tests/conformance \
        --parallel $((2 * $(nproc))) --repeat until-pass:2 --output-on-failure || true
    finish release-tests || true
}

# Clang's build: so the tests also see whether another compiler gives other bits.
test_asan() {
    [[ -n ${running[asan-build]-} ]] || begin asan-build build_asan
    finish asan-build || return
    begin tidy check_tidy
    step "asan tests" ctest --preset asan --parallel "$(nproc)" || true
    finish tidy
}

# Says why a test was left out, where one was.
test_programs() {
    local tests=build/release/tests/e2e/programs
    ctest --test-dir "$tests" -C programs --label-regex "^${1:-programs}\$" \
        --parallel "$(nproc)" --output-on-failure --no-tests=error
    sed -n 's/^skipped: /left out: /p' "$tests/Testing/Temporary/LastTest.log"
}

build_programs() {
    cmake --preset release && cmake --build --preset release --parallel "$(nproc)" \
        --target hapnet-emulator hapnet-ctl own_loopback
}

build_web() {
    cmake --preset release && cmake --build --preset release --parallel "$(nproc)" \
        --target hapnet-web hapnet-peer hapnet-emulator hapnet-lab
}

# test_web [OPTION... FILE]: all tests in a browser, or those of a file that node's options choose.
# The modules of the page and of its tests are as the lock file has them.
test_web() {
    local program
    for program in node npm chromium; do
        command -v "$program" >/dev/null || { echo "left out: $program is missing" && return; }
    done
    (($# > 0)) || set -- tests/web/*.test.mjs
    (cd web/page && npm ci --ignore-scripts --no-audit --no-fund) || return
    mkdir -p "$logs/web"
    HAPNET_WEB_PICTURES=$PWD/$logs/web node --test --test-concurrency=1 --test-reporter=spec \
        "$@"
}

build_fleet() {
    cmake --preset release && cmake --build --preset release --parallel "$(nproc)" \
        --target hapnet-lab made_sessions
}

# Each kind, as far as it can be tried in seconds with what is built.
test_kinds() {
    step "programs smoke" test_programs smoke || true
    step "web smoke" test_web --test-name-pattern="^loads in space" \
        tests/web/page.test.mjs || true
    step "ship smoke" try_package || true
    step "fleet smoke" tests/fleet/fleet_test.sh . build/release/bin build/fleet-smoke 1 local
}
try_package() {
    tests/ship/smoke_test.sh . build/release build/ship-smoke || (($? == 77))
}

# tally LOG...: how many tests passed, failed and were left out in all of them: 4 passed, 1 failed.
tally() {
    local run logs_read=()
    for run in "$@"; do
        [[ ! -f $logs/$run.log ]] || logs_read+=("$logs/$run.log")
    done
    cat "${logs_read[@]}" </dev/null | awk '
        /% tests passed, .* tests? failed out of/ { failed += $4; all += $NF }
        /^[ \t]*[0-9]+ - .*\(Skipped\)$/ { skipped++ }
        END {
            printf "%d passed", all - failed - skipped
            if (failed) printf ", %d failed", failed
            if (skipped) printf ", %d skipped", skipped
        }'
}

# closing LOG...: how the tests of each ended, and which failed.
closing() {
    local run
    for run in "$@"; do
        if grep -q '% tests passed' "$logs/$run.log" 2>/dev/null; then
            printf '%s: %s\n' "${run/-/ }" "$(tally "$run")"
            sed -n '/^The following tests FAILED:/,/^$/p' "$logs/$run.log"
        else
            printf '%s: not run to the end\n' "${run/-/ }"
        fi
    done
}

if [[ $kind == ship ]]; then
    step "ship" tests/ship/ship_test.sh "$PWD" "$PWD/build/ship" || true
    runs=()
elif [[ $kind == fleet ]]; then
    bin=$PWD/build/release/bin
    if step "build" build_fleet; then
        step "fleet" tests/fleet/fleet_test.sh "$PWD" "$bin" "$PWD/build/fleet" || true
        step "million" tests/fleet/million_test.sh "$bin" \
            "$bin/made_sessions" "$PWD/build/fleet-million" 1000000 || true
    fi
    runs=()
elif [[ $kind == web ]]; then
    { step "build" build_web && step "web" test_web; } || true
    runs=()
elif [[ -n $kind ]]; then
    { step "build" build_programs && step "programs" test_programs; } || true
    runs=(programs)
else
    step "format" check_format || true
    step "scripts" check_scripts || true
    step "pages" check_pages || true
    test_release || true
    [[ -z $all ]] || test_kinds || true
    [[ -z $all ]] || test_asan || true
    runs=(release-e2e release-tests release-conformance ${all:+programs-smoke} ${all:+asan-tests})
fi

printf '\n== what the tests say\n'
closing "${runs[@]}"
printf '\n== summary\n'
printf '%s\n' "${summary[@]}"
if ((failed > 0)); then
    printf 'test: %d of %d steps FAILED after %d s; see %s\n' \
        "$failed" "${#summary[@]}" "$SECONDS" "$PWD/$logs"
    ((${#runs[@]} == 0)) || printf '%s in %d s\n' "$(tally "${runs[@]}")" "$SECONDS"
    exit 1
fi
printf 'test: all %d steps passed in %d s\n' "${#summary[@]}" "$SECONDS"
((${#runs[@]} == 0)) || printf '%s in %d s\n' "$(tally "${runs[@]}")" "$SECONDS"
