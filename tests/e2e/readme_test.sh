#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Pastes the ```sh blocks of a Markdown page into an interactive bash that has a background job of
# its own, on loopback. A block fails when one of its commands fails, when that job does not outlive
# it, or when it leaves a job of its own behind. Blocks after a line
# "<!-- not run by readme_test: why -->" are left out. A ```python, ```toml or ```cmake block that
# begins with the comment "# NAME" is saved as the file NAME first, as the page tells its reader.
# Every ```python block has to be such a file, and a command of the page has to name it.
# Usage: readme_test.sh PAGE FOLDER-WITH-THE-PROGRAMS [FEWEST-BLOCKS-TO-RUN [TRIAL...]]
# TRIAL is a command of hapnet-emulator; when it exits with 3, the system refuses what the page is
# about, and nothing is run.
# HAPNET_PAGE_FOLDER: the blocks run in this folder, and what they make stays there.
# HAPNET_PAGE_SECONDS: the time that one block may take, instead of a minute.
set -euo pipefail

page=$(realpath "$1")
programs=$(realpath "$2")
blocks_min=${3:-1}
trial=("${@:4}")
seconds_max=${HAPNET_PAGE_SECONDS:-60} # for one block

folder=${HAPNET_PAGE_FOLDER:-$(mktemp -d)}
[[ -n ${HAPNET_PAGE_FOLDER-} ]] || trap 'rm -rf "$folder"' EXIT
command -v script >/dev/null || { echo "skipped: script is missing (Debian: bsdutils)" && exit 77; }
# A clone, with the files that the pages use.
repository=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../..")
mkdir -p "$folder/build"
ln -s "$(dirname "$programs")" "$folder/build/release"
ln -s "$repository/examples" "$repository/python" "$folder"
cd "$folder"

if ((${#trial[@]} > 0)); then
    code=0
    build/release/bin/hapnet-emulator "${trial[@]}" || code=$?
    ((code != 3)) || { echo "skipped: the system refuses it" && exit 77; }
fi

awk '
    /^<!-- not run by readme_test: / { left_out = 1; next }
    /^```sh$/ && !left_out { file = sprintf("block-%03d.sh", NR); next }
    /^```(python|toml|cmake)$/ && !left_out { kind = substr($0, 4); next }
    kind && /^# [[:alnum:]_./-]+$/ {
        file = $2
        if (split(file, parts, "/") > 1) system("mkdir -p " parts[1])
        if (kind == "python") print file > "files-to-run"
    }
    kind && !file && kind == "python" {
        print "the python block before line " NR " does not begin with the name of its file"
        exit 1
    }
    { kind = "" }
    /^```/ { file = ""; left_out = 0 }
    file { print > file }
' "$page" >&2

shopt -s nullglob
blocks=(block-*.sh)
if ((${#blocks[@]} < blocks_min)); then
    echo "only ${#blocks[@]} blocks to run in $page; expected $blocks_min or more" >&2
    exit 1
fi

export PATH=$programs:$PATH # for pages that are read beside installed programs
cat >"$folder/shell.rc" <<'shell'
PS1='$ ' PS2= HISTFILE=
sleep 1000 &
echo "$!" >.job
set -o errtrace
trap 'echo "exit code $?: $BASH_COMMAND" >>.failures' ERR
shell

# The jobs that are left, once those that were told to end had a second for it.
# shellcheck disable=SC2016 # the pasted shell expands these
last_words='for _ in {1..10}; do (($(jobs -pr | wc -l) > 1)) || break; sleep 0.1; done
jobs -pr >.left; exit 0'

# paste BLOCK: types it line by line into a new terminal, and shows the terminal's output.
paste() {
    rm -f .failures .left
    { cat "$1" && printf '\n%s\n' "$last_words"; } |
        TERM=dumb timeout --kill-after 5 "$seconds_max" script --quiet --return --command \
            'bash --noediting --noprofile --rcfile shell.rc -i' /dev/null
}

# judge: says what is wrong with the block that was pasted last.
judge() {
    local job
    job=$(<.job)
    if [[ ! -e .left ]]; then
        echo "it did not come to its end within $seconds_max s"
    elif [[ -e .failures ]]; then
        cat .failures
    elif ! grep -qxF "$job" .left; then
        echo "it ended a background job that is not its own"
    elif [[ $(<.left) != "$job" ]]; then
        echo "it left a job behind: $(grep -vxF "$job" .left | xargs -r ps -o args= -p)"
    fi
    kill "$job" 2>/dev/null || true
}

if [[ -e files-to-run ]]; then
    while read -r file; do
        grep -qF " $file" "${blocks[@]}" ||
            { echo "no command of $page names $file" >&2 && exit 1; }
    done <files-to-run
fi

for block in "${blocks[@]}"; do
    line=$((10#${block//[^0-9]/}))
    printf '\n== %s, the block at line %d\n' "$page" "$line"
    begin=$SECONDS
    paste "$block" || true
    wrong=$(judge)
    if [[ -n $wrong ]]; then
        printf 'FAILED: the block at line %d of %s: %s\n' "$line" "$page" "$wrong" >&2
        tail -n 20 ./*.log results/*/*.log 2>/dev/null >&2 || true
        exit 1
    fi
    printf -- '-- %d s\n' $((SECONDS - begin))
done
