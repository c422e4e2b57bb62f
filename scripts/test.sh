#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Installs what is missing, builds, and runs the tests. docs/design/tests.md lists the tests.
set -euo pipefail

usage="usage: scripts/test.sh [--all | KIND]
Installs what is missing, builds what the tests need with GCC (preset release) and runs them: unit,
property, simulation, conformance, bits, the rules of the house, programs end to end; and checks the
format of the sources and the scripts. About 11 minutes on two cores.
--all also runs the kinds long and sanitizers.
KIND runs one kind instead:
  long        the release tests that take longer (whole matrices, costs, benches, Python, libraries,
              the live page, every page with commands), and some seconds of each kind below
  sanitizers  the tests and the fuzz corpora with Clang under AddressSanitizer and
              UndefinedBehaviorSanitizer, and clang-tidy over the sources. The programs themselves
              and emulated devices are the workflow asan-e2e instead
  clock       the tests that meet a real clock and those about permissions, of what is built
  programs    other people's programs through the emulator: curl, dig, iperf, iperf3, mosh, ping and
              QUIC
  ship        packages, made, installed in a bare root and removed, and images of them; as root
  web         the live page in Chromium; left out, with the reason, where node, npm or chromium is
              missing
  fleet       a plan in shards by GNU parallel, over ssh to this machine and as an array on a Slurm
              cluster of one node, which it starts and ends, as root; and a million sessions
A test that cannot run here is skipped, and the last lines count skips by reason. What each step
said is in build/test-logs. Exits 0 when all passed, 1 when something failed, 2 for an unknown
argument, 3 when something that it needs cannot be installed."

refuse() {
    echo "test: $1"$'\n'"$usage" >&2
    exit 2
}

cd "$(dirname "${BASH_SOURCE[0]}")/.."
all=
kind=
(($# <= 1)) || refuse "one argument at most, not $#"
case ${1-} in
'') kind=default ;;
--all) kind=default all=yes ;;
-h | --help) echo "$usage" && exit 0 ;;
long | sanitizers | clock | programs | ship | web | fleet) kind=$1 ;;
-*) refuse "unknown argument '$1'" ;;
*) refuse "unknown kind '$1': use long, sanitizers, clock, programs, ship, web or fleet" ;;
esac

case $kind in
default) scripts/setup.sh --test ${all:+--package --web} ;;
long) scripts/setup.sh --test --package --web ;;
sanitizers) scripts/setup.sh --test ;;
clock) ;; # what is built was built with what it needs
programs) scripts/setup.sh --test --programs ;;
web) scripts/setup.sh --web ;;
ship) scripts/setup.sh --package --ship ;;
fleet) scripts/setup.sh --test --fleet ;;
esac
release=build/release
# By default, tests with the label all are left out, and the programs that only they need.
left_out=all programs=end_to_end rest=default_tests
[[ -z $all ]] || left_out=none programs=end_to_end_all rest=all
logs=build/test-logs
[[ $kind == default ]] || logs=$logs/$kind
rm -rf "$logs"
mkdir -p "$logs"
summary=()
runs=() # the steps in which tests ran
failed=0

# step NAME COMMAND...: runs the command, shows and keeps its output, and notes its result.
step() {
    local name=$1 begin=$SECONDS verdict=ok
    shift
    printf '\n== %s: %s\n' "$name" "$*"
    "$@" 2>&1 | tee "$logs/${name// /-}.log" || verdict=FAILED
    summary+=("$(printf '%-6s %4d s  %s' "$verdict" $((SECONDS - begin)) "$name")")
    [[ $verdict == ok ]] || failed=$((failed + 1))
    [[ $verdict == ok ]]
}

# begin "COMMAND..." NAME FUNCTION: runs the function in the background, by that command.
declare -A running=()
begin() {
    local command
    read -ra command <<<"$1"
    echo "$2: begins beside what follows"
    export -f "${3?}" run_tests
    export logs release left_out rest
    "${command[@]}" bash -euo pipefail -c "$3" >"$logs/$2.begun.log" 2>&1 &
    running[$2]=$!
}
# The lowest priority of all: tests wait for much of their time.
idle="chrt --idle 0"

# finish NAME: waits for the end of what begin() began, and reports it as a step.
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

# run_tests NAME FOLDER OPTION...: runs the tests of that folder. Keeps the output of each.
run_tests() {
    local code=0
    ctest --test-dir "$2" --output-on-failure --no-tests=error "${@:3}" || code=$?
    cp "$2/Testing/Temporary/LastTest.log" "$logs/$1.said"
    echo "$2" >"$logs/$1.folder"
    return "$code"
}
# test_step NAME FOLDER OPTION...: runs them as a step.
test_step() {
    runs+=("$1")
    step "$1" run_tests "$@"
}

check_format() {
    find proto scene emulator ctl device peer lab web examples tests -name '*.[ch]pp' -print0 |
        xargs -0 -P "$(nproc)" -n 64 clang-format-14 --dry-run --Werror
}

check_scripts() {
    find scripts .ci tests -type f \( -name '*.sh' -o -path '.ci/*' \) -print0 |
        xargs -0 -P "$(nproc)" -n 8 shellcheck
}

# Checks that the scripts of our pages parse, where there is a node for it.
check_pages() {
    ! command -v node >/dev/null || find lab web/page tests/web -name node_modules -prune -o \
        -name '*.*js' -type f -print0 | xargs -0 -P "$(nproc)" -n 1 node --check
}

build() {
    cmake --preset "$1" && cmake --build --preset "$1" --parallel "$(nproc)" --target "${@:2}"
}
# With a list of all tests: two parallel runs must not both write it.
build_release() {
    ninja -C "$release" "$rest" && ctest --test-dir "$release" --show-only
}
build_asan() { cmake --preset asan && cmake --build --preset asan --parallel "$(nproc)"; }
# Reads all but the tests, and compiles nothing: cmake/HapnetTidy.cmake says how.
check_tidy() { cmake --preset tidy && cmake --build --preset tidy --parallel "$(nproc)"; }

# Runs all tests that do not wait.
run_release_tests() {
    run_tests release-tests "$release" --parallel "$(nproc)" \
        --label-exclude "^(e2e|conformance|$left_out)\$"
}

# The tests end to end wait for most of their time, so all but the programs that they start is built
# beside them. ctest reads their folder alone, because programs of other folders may be incomplete.
# The other tests run beside them, and only those of devices wait.
test_release() {
    step "release-programs" build release "$programs" || return
    begin "$idle" release-build build_release
    test_step release-e2e "$release/tests/e2e" --parallel $((2 * $(nproc))) \
        --label-exclude "^$left_out\$" || true
    finish release-build || return
    [[ -z $all ]] || begin "$idle" asan-build build_asan
    begin "nice -n 19" release-tests run_release_tests
    # The emulated devices keep real time, and wait for most of it.
    test_step release-conformance "$release/tests/conformance" --parallel $((2 * $(nproc))) || true
    runs+=(release-tests)
    finish release-tests || true
}

# The tests of the release build that only --all runs.
test_long() {
    step "long-build" build release all || return
    test_step long-tests "$release" --parallel "$(nproc)" --label-regex '^all$' || true
    test_kinds || true
}

# Clang's build also shows whether another compiler gives other bits.
test_sanitizers() {
    [[ -n ${running[asan-build]-} ]] || begin "nice" asan-build build_asan
    finish asan-build || return
    begin "$idle" tidy check_tidy
    test_step asan-tests build/asan --parallel "$(nproc)" || true
    finish tidy
}

test_clock() {
    # They wait for most of their time.
    test_step clock-tests "$release" --parallel $((2 * $(nproc))) \
        --label-regex '^(clock|permissions)$'
}

# test_programs [LABEL]
test_programs() {
    run_tests "${1:+programs-}${1:-programs}" "$release/tests/e2e/programs" -C programs \
        --label-regex "^${1:-programs}\$" --parallel "$(nproc)"
}

# test_web [OPTION... FILE]: all tests in a browser, or those of a file that node's options choose.
# The driver of the browser is as the lock file has it; the page itself needs no module of npm.
test_web() {
    local program
    for program in node npm chromium; do
        command -v "$program" >/dev/null || { echo "left out: $program is missing" && return; }
    done
    (($# > 0)) || set -- tests/web/*.test.mjs
    (cd tests/web && npm ci --ignore-scripts --no-audit --no-fund) || return
    mkdir -p "$logs/web"
    HAPNET_WEB_PICTURES=$PWD/$logs/web node --test --test-concurrency=1 --test-reporter=spec \
        "$@"
}

# Tries each kind in seconds, with the programs already built.
test_kinds() {
    runs+=(programs-smoke)
    step "programs-smoke" test_programs smoke || true
    step "web-smoke" test_web --test-name-pattern="^loads in space" \
        tests/web/page.test.mjs tests/web/debian_three.test.mjs || true
    step "ship-smoke" try_package || true
    step "fleet-smoke" tests/fleet/fleet_test.sh . "$release/bin" build/fleet-smoke 1 local
}
try_package() {
    tests/ship/smoke_test.sh . "$release" build/ship-smoke || (($? == 77))
}

# tally LOG...: how many tests passed, failed and were left out in all of them: 4 passed, 1 failed.
tally() {
    local run logs_read=()
    for run in "$@"; do
        [[ ! -f $logs/$run.log ]] || logs_read+=("$logs/$run.log")
    done
    cat "${logs_read[@]}" </dev/null | awk '
        /% tests passed, .* tests? failed out of/ { failed += $4; all += $NF }
        /^second turn: / { failed += $3 }
        /^[ \t]*[0-9]+ - .*\(Skipped\)$/ { skipped++ }
        END {
            printf "%d passed, %d failed", all - failed - skipped, failed
            if (skipped) printf ", %d skipped", skipped
        }'
}

# reasons RUN: the reason and the name of each test that was skipped, with a tab between. ctest
# names them; the reason stands in what they said: after "skipped: ", or in the line after
# GoogleTest's ": Skipped".
reasons() {
    [[ -f $logs/$1.said && -f $logs/$1.log ]] || return 0
    awk '
        FNR == NR && /" start time: / {
            name = $0
            sub(/^"/, "", name)
            sub(/" start time: .*/, "", name)
        }
        FNR == NR && is_next { reason[name] = $0; is_next = 0 }
        FNR == NR && /: Skipped$/ { is_next = 1 }
        FNR == NR && /^skipped: / { reason[name] = substr($0, 10) }
        FNR < NR && /^[ \t]*[0-9]+ - .*\(Skipped\)$/ {
            name = $0
            sub(/^[ \t]*[0-9]+ - /, "", name)
            sub(/ \(Skipped\)$/, "", name)
            why = reason[name] == "" ? "no reason given" : reason[name]
            sub(/: .*/, "", why)
            print why "\t" name
        }' "$logs/$1.said" "$logs/$1.log"
}

# skips RUN...: how many tests were skipped for each reason, the most frequent first.
skips() {
    local run
    for run in "$@"; do reasons "$run"; done | cut -f1 | sort | uniq -c | sort -rn
}

# second_turn RUN...: the tests that were skipped because the machine was never quiet run once more,
# one at a time, now that nothing of ours runs beside them. Where there are more than ten, something
# else keeps the machine busy, and they stay skipped. The result of the second turn counts.
second_turn_max=10
second_turn() {
    local run names count
    for run in "$@"; do
        [[ -e $logs/$run.log ]] || continue # the build failed before
        last_words "$run" >"$logs/$run.words"
        names=$(reasons "$run" | awk -F'\t' '$1 == "the machine was never quiet" { print $2 }')
        count=$(grep -c . <<<"$names" || true)
        ((count > 0 && count <= second_turn_max)) || continue
        step "$run-again" run_tests "$run-again" "$(cat "$logs/$run.folder")" \
            --tests-regex "^(${names//$'\n'/|})\$" || true
        awk 'FNR == NR { second[$0 " (Skipped)"]; next }
            { name = $0; sub(/^[ \t]*[0-9]+ - /, "", name) }
            !(name in second)' <(echo "$names") "$logs/$run.log" >"$logs/$run.kept"
        sed -n '/^[ \t]*[0-9]* - .*(Skipped)$/p; /^The following tests FAILED:/,/^$/p
            s/.*% tests passed, \([0-9]*\) tests\? failed out of.*/second turn: \1 failed/p' \
            "$logs/$run-again.log" >>"$logs/$run.kept"
        mv "$logs/$run.kept" "$logs/$run.log"
        cat "$logs/$run-again.said" >>"$logs/$run.said"
        last_words "$run-again" >>"$logs/$run.words"
    done
}

# last_words RUN: the last 20 lines of each test that failed, for the first five.
last_words() {
    awk 'function close_test(i) {
            for (i = count > 20 ? count - 20 : 0; i < count; i++) print "    " said[i]
            is_open = count = 0
        }
        /^ *([0-9]+\/[0-9]+ Test|Start) +#?[0-9]+:/ { close_test() }
        /^[0-9]+% tests passed/ { close_test() }
        is_open { said[count++] = $0 }
        /^ *[0-9]+\/[0-9]+ Test .*\*\*\*/ && !/\*\*\*(Skipped|Not Run)/ && ++failed <= 5 {
            print "  the end of what it said: " $4
            is_open = 1
        }
        END { close_test() }' "$logs/$1.log"
}

# closing RUN...: prints how the tests of each run ended, and which failed.
closing() {
    local run
    for run in "$@"; do
        if grep -q '% tests passed' "$logs/$run.log" 2>/dev/null; then
            printf '%s: %s\n' "${run/-/ }" "$(tally "$run")"
            sed -n '/^The following tests FAILED:/,/^$/p' "$logs/$run.log"
            [[ ! -s $logs/$run.words ]] || cat "$logs/$run.words"
        else
            printf '%s: not run to the end\n' "${run/-/ }"
        fi
    done
    skips "$@" >"$logs/skipped.txt"
    [[ ! -s $logs/skipped.txt ]] || { echo "skipped tests, by reason:" && cat "$logs/skipped.txt"; }
}

case $kind in
default)
    step "format" check_format || true
    step "scripts" check_scripts || true
    step "pages" check_pages || true
    test_release || true
    [[ -z $all ]] || test_kinds || true
    [[ -z $all ]] || test_sanitizers || true
    ;;
long) test_long || true ;;
sanitizers) test_sanitizers || true ;;
clock) test_clock || true ;;
programs)
    runs=(programs)
    { step "build" build release hapnet-emulator hapnet-ctl own_loopback &&
        step "programs" test_programs; } || true
    ;;
web)
    { step "build" build release hapnet-web hapnet-peer hapnet-emulator hapnet-lab &&
        step "web" test_web; } || true
    ;;
ship) step "ship" tests/ship/ship_test.sh "$PWD" "$PWD/build/ship" || true ;;
fleet)
    bin=$PWD/$release/bin
    if step "build" build release hapnet-lab made_sessions; then
        step "fleet" tests/fleet/fleet_test.sh "$PWD" "$bin" "$PWD/build/fleet" || true
        step "million" tests/fleet/million_test.sh "$bin" \
            "$bin/made_sessions" "$PWD/build/fleet-million" 1000000 || true
    fi
    ;;
esac

second_turn "${runs[@]}"
printf '\n== what the tests say\n'
closing "${runs[@]}"
printf '\n== summary\n'
printf '%s\n' "${summary[@]}"
verdict="all ${#summary[@]} steps passed in $SECONDS s"
if ((failed > 0)); then
    verdict="$failed of ${#summary[@]} steps FAILED after $SECONDS s; see $PWD/$logs"
fi
echo "test: $verdict"
((${#runs[@]} == 0)) || printf '%s in %d s\n' "$(tally "${runs[@]}")" "$SECONDS"
((failed == 0))
