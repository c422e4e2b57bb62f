#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# curl loads a file whole, between two networks and from a network of its own, over 80 ms and 5 %.
# shellcheck source=tests/e2e/programs/lib.sh
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh" "$1" curl python3

head -c 200000 /dev/urandom >file
mkdir got
run_between --delay 40ms --loss 5% -- \
    curl -sS --retry 30 --retry-connrefused -o got/file http://b:8000/file --- \
    python3 -m http.server 8000
cmp file got/file || fail "the file has changed on its way"

python3 -m http.server 8001 --bind 127.0.0.1 >server.log 2>&1 &
curl -sS --retry 30 --retry-connrefused -o got/file http://127.0.0.1:8001/file
rm got/file
code=0
"$emulator" exec --delay 40ms --loss 5% --stats exec.json -- \
    curl -sS -o got/file "http://host:8001/file" >exec.log 2>exec.err || code=$?
if ((code == 3)); then
    echo "not tested: exec: $(tail -n 1 exec.err)"
else
    ((code == 0)) || fail "curl through exec ended with $code"
    cmp file got/file || fail "the file has changed on its way through exec"
    expect_counts exec.json
fi
"$emulator" exec -- curl -sS "http://host:8001/none" --fail >exec.log 2>exec.err || code=$?
((code == 22 || code == 3)) || fail "curl's exit code 22 became $code"
echo passed
