#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Installs what is missing, builds, and runs every test: optimised with GCC; all but the programs'
# with Clang under AddressSanitizer and UndefinedBehaviorSanitizer (for those: the workflow
# asan-e2e); and through clang-tidy.
set -euo pipefail

usage="usage: scripts/test.sh [--quick]
Runs every test; --quick runs those of the release preset alone. Exits 0 when all passed,
1 when something failed."

cd "$(dirname "${BASH_SOURCE[0]}")/.."
presets=(release asan)
for argument in "$@"; do
    case $argument in
    --quick) presets=(release) ;;
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
    find proto emulator device peer lab tests -name '*.[ch]pp' -print0 |
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

# The tests of the sanitizers and those end to end leave processors idle: clang-tidy has those, at
# the lowest priority there is.
tidy=
begin_tidy() {
    echo "clang-tidy runs beside the tests that follow"
    export -f check_tidy
    chrt --idle 0 bash -euo pipefail -c check_tidy >"$logs/clang-tidy.log" 2>&1 &
    tidy=$!
}

# Builds a preset and runs its tests but those end to end. Which kinds those are, the preset says.
# The sanitizers' build is Clang's: so the tests also see whether another compiler gives other bits.
run_preset() {
    local preset=$1 is_built=
    step "$preset configure" cmake --preset "$preset" &&
        step "$preset build" cmake --build --preset "$preset" --parallel "$(nproc)" &&
        is_built=yes
    [[ $preset != asan ]] || begin_tidy
    [[ -n $is_built ]] || return 1
    step "$preset tests" ctest --preset "$preset" --parallel "$(nproc)" \
        --label-exclude '^(e2e|conformance)$' || true
    # Emulated devices keep real time, and wait for most of it.
    step "$preset conformance" ctest --preset "$preset" --parallel $((3 * $(nproc))) \
        --label-regex '^conformance$'
}

step "format" check_format || true
step "scripts" check_scripts || true
step "pages" check_pages || true
for preset in "${presets[@]}"; do run_preset "$preset" || true; done
step "release e2e" ctest --preset release --label-regex '^e2e$' || true
show_tidy() {
    cat "$logs/clang-tidy.log"
    [[ $tidy_exit == 0 ]]
}
if [[ -n $tidy ]]; then
    echo "waiting for clang-tidy"
    tidy_exit=0
    wait "$tidy" || tidy_exit=$?
    step "tidy" show_tidy || true
fi

printf '\n== what the tests say\n'
for run in "${presets[@]/%/-tests}" "${presets[@]/%/-conformance}" release-e2e; do
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
