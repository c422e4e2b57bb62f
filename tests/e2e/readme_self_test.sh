#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# readme_test.sh finds each kind of example that does not work when it is pasted.
# Usage: readme_self_test.sh FOLDER-WITH-THE-PROGRAMS
set -euo pipefail
programs=$1
tester=$(dirname "${BASH_SOURCE[0]}")/readme_test.sh
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export HAPNET_PAGE_SECONDS=5

# page LANGUAGE TEXT: a page with one block.
# shellcheck disable=SC2016 # backquotes of Markdown
page() { printf '```%s\n%s\n```\n' "$1" "$2" >>"$work/page.md"; }

# expect CODE WORDS: readme_test.sh ends with that code, and says that of the page.
expect() {
    local code=0
    "$tester" "$work/page.md" "$programs" >"$work/said" 2>&1 || code=$?
    if ((code != $1)) || ! grep -q -e "$2" "$work/said"; then
        printf 'FAILED: of this page it ends with %d and not %d, or does not say "%s":\n' \
            "$code" "$1" "$2"
        cat "$work/page.md" "$work/said"
        exit 1
    fi
    rm "$work/page.md"
}

page sh $'sleep 2 & mine=$!\nkill $mine; wait $mine || true'
expect 0 '^-- '
page sh 'ls no-such-file'
expect 1 'exit code 2: ls no-such-file'
page sh $'sleep 2 &\nkill %1'
expect 1 'ended a background job that is not its own'
page sh $'sleep 1 &\nwait'
expect 1 'did not come to its end'
page sh 'sleep 20 &'
expect 1 'left a job behind: sleep 20'
page sh 'read -r line'
page sh 'exit 0'
expect 1 'FAILED'
page python 'print("saved by no name")'
page sh 'python3 some.py'
expect 1 'does not begin with the name of its file'
page python $'# some.py\nprint("run by no command")'
page sh 'true'
expect 1 'no command of .* names some.py'
page python $'# some.py\nprint("to be seen")'
page sh 'python3 some.py'
expect 0 'to be seen'
