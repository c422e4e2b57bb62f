#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Tests the output of programs for packages: manual pages for scdoc, and completions for shells.
#   install_test.sh BIN_DIR PYTHON_DIR
set -euo pipefail
work=$(mktemp -d)
bin=$work/bin # the programs, and what Python brings
mkdir "$bin"
ln -s "$1"/hapnet-* "$2/hapnet-study" "$bin"
trap 'rm -rf "$work"' EXIT

fail() {
    echo "install_test: $1" >&2
    exit 1
}

# completes PROGRAM WORD... : what bash offers for the last of these words.
completes() {
    bash -c '
        source "$1"
        shift
        COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMPREPLY=()
        function=_${1//-/_}
        "$function"
        printf "%s\n" "${COMPREPLY[@]}"' - "$work/$1.bash" "$@"
}

for program in hapnet-emulator hapnet-ctl hapnet-peer hapnet-lab hapnet-study; do
    for what in man bash zsh fish; do
        "$bin/$program" --generate "$what" >"$work/$program.$what"
        [[ -s $work/$program.$what ]] || fail "$program writes nothing for $what"
    done
    bash -n "$work/$program.bash"
    ! command -v zsh >/dev/null || zsh -n "$work/$program.zsh"
    ! command -v fish >/dev/null || fish -n "$work/$program.fish"
    grep -q "^# OPTIONS$" "$work/$program.man" || fail "the page of $program has no options"
    # The long options of --help are all in the page and in the completions.
    while read -r option; do
        plain=$(sed 's/\\//g' "$work/$program.man")
        [[ $plain == *"*$option*"* ]] || fail "$option of $program is not in its page"
        grep -q -- "$option" "$work/$program.bash" || fail "bash does not know $option of $program"
    done < <("$bin/$program" --help | sed -n 's/^  \(-., \)\?\(--[a-z-]*\)[ ,].*/\2/p' |
        grep -v generate)
    if command -v scdoc >/dev/null; then
        scdoc <"$work/$program.man" >"$work/$program.1"
        grep -q '^\.SH EXIT STATUS' "$work/$program.1" || fail "scdoc made no page of $program"
    fi
done

[[ $(completes hapnet-emulator pred) == predict ]] || fail "pred is not completed"
[[ $(completes hapnet-emulator --timing e) == eco ]] || fail "--timing e is not completed"
[[ $(completes hapnet-emulator --up) == --upstream ]] || fail "--up is not completed"
[[ $(completes hapnet-emulator probe --qu) == --quiet ]] || fail "probe --qu is not completed"
[[ $(completes hapnet-study an) == analyse ]] || fail "an is not completed"
[[ $(completes hapnet-study run --observer s) == simulated ]] || fail "--observer s"
[[ $(completes hapnet-study run --part) == $'--participant\n--partner' ]] || fail "run --part"
[[ -z $(completes hapnet-emulator --profile x) ]] || fail "a file is left to the shell"
if command -v fish >/dev/null; then
    # fish_completes LINE: what fish offers for it.
    fish_completes() {
        HOME=$work fish -c "source $work/hapnet-emulator.fish; complete -C '$1'" | cut -f 1
    }
    [[ $(fish_completes "hapnet-emulator pred") == predict ]] || fail "fish: pred"
    [[ $(fish_completes "hapnet-emulator --timing e") == eco ]] || fail "fish: --timing e"
    [[ $(fish_completes "hapnet-emulator --up") == *--upstream* ]] || fail "fish: --up"
fi
if command -v zsh >/dev/null; then
    # The offers that zsh's completion would get, without a terminal.
    offered=$(zsh -fc '_describe() { print -rl -- $commands }; _arguments() { print -rl -- "$@" }
        words=(hapnet-emulator "") CURRENT=2; source '"$work/hapnet-emulator.zsh")
    for one in "predict:" "--timing\[.*:(eco precise " "--upstream\["; do
        grep -q -- "^\*\?$one" <<<"$offered" || fail "zsh: $one"
    done
fi

! "$bin/hapnet-ctl" --generate perl 2>"$work/refused" || fail "perl is no shell"
grep -q "expected one of man|bash|zsh|fish" "$work/refused" || fail "perl: $(cat "$work/refused")"
echo "install_test: all programs"
