#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Installs what is missing, builds, and runs every test: optimised with GCC; all but those of
# programs, their commands and emulated devices with Clang under AddressSanitizer and
# UndefinedBehaviorSanitizer (for those: the workflow asan-e2e); and through clang-tidy.
set -euo pipefail

usage="usage: scripts/test.sh [--quick]
Runs every test; --quick runs those of the release preset alone. Exits 0 when all passed,
1 when something failed."

cd "$(dirname "${BASH_SOURCE[0]}")/.."
sanitizers=yes
for argument in "$@"; do
    case $argument in
    --quick) sanitizers= ;;
    -h | --help) echo "$usage" && exit 0 ;;
    *) echo "test: unknown argument '$argument'"$'\n'"$usage" >&2 && exit 2 ;;
    esac
done

scripts/setup.sh --test
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
    find proto scene emulator ctl device peer lab tests -name '*.[ch]pp' -print0 |
        xargs -0 clang-format-14 --dry-run --Werror
}

check_scripts() {
    find scripts .ci tests -type f \( -name '*.sh' -o -path '.ci/*' \) -print0 | xargs -0 shellcheck
}

# Whether the scripts of our pages parse, where there is a node to say so.
check_pages() {
    ! command -v node >/dev/null || find lab -name '*.js' -print0 | xargs -0 -n 1 node --check
}

# Reads all but the tests, and compiles nothing: cmake/HapnetTidy.cmake says how.
check_tidy() {
    cmake --preset tidy && cmake --build --preset tidy --parallel "$(nproc)"
}

build_asan() {
    cmake --preset asan && cmake --build --preset asan --parallel "$(nproc)"
}

# begin NAME FUNCTION: runs it beside what follows, at the lowest priority there is: tests wait for
# much of their time.
declare -A running=()
begin() {
    echo "$1: begins beside what follows"
    export -f "${2?}"
    chrt --idle 0 bash -euo pipefail -c "$2" >"$logs/$1.begun.log" 2>&1 &
    running[$1]=$!
}

# finish NAME: waits for what begin() began, and is the step of it.
finish() {
    begun_exit=0
    wait "${running[$1]}" || begun_exit=$?
    step "$1" show_begun "$1"
}
show_begun() {
    cat "$logs/$1.begun.log"
    [[ $begun_exit == 0 ]]
}

# The emulated devices keep real time, and wait for most of it. One that a busy machine kept waiting
# may try once more.
test_release() {
    step "release configure" cmake --preset release &&
        step "release build" cmake --build --preset release --parallel "$(nproc)" || return
    step "release tests" ctest --preset release --parallel "$(nproc)" \
        --label-exclude '^(e2e|conformance)$' || true
    step "release conformance" ctest --preset release --parallel $((2 * $(nproc))) \
        --label-regex '^conformance$' --repeat until-pass:2 || true
    [[ -z $sanitizers ]] || begin asan-build build_asan
    step "release e2e" ctest --preset release --label-regex '^e2e$' || true
}

# Clang's build: so the tests also see whether another compiler gives other bits.
test_asan() {
    [[ -n ${running[asan-build]-} ]] || begin asan-build build_asan
    finish asan-build || return
    begin tidy check_tidy
    step "asan tests" ctest --preset asan --parallel "$(nproc)" || true
    finish tidy
}

step "format" check_format || true
step "scripts" check_scripts || true
step "pages" check_pages || true
test_release || true
[[ -z $sanitizers ]] || test_asan || true

printf '\n== what the tests say\n'
for run in release-tests release-conformance release-e2e ${sanitizers:+asan-tests}; do
    closing=$(sed -n '/% tests passed/,$p' "$logs/$run.log" 2>/dev/null || true)
    printf '%s: %s\n' "${run/-/ }" "${closing:-not run to the end}"
done
printf '\n== summary\n'
printf '%s\n' "${summary[@]}"
if ((failed > 0)); then
    printf 'test: %d of %d steps FAILED after %d s; see %s\n' \
        "$failed" "${#summary[@]}" "$SECONDS" "$PWD/$logs"
    exit 1
fi
printf 'test: all %d steps passed in %d s\n' "${#summary[@]}" "$SECONDS"
