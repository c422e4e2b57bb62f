#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# A mosh session through a relay, over 80 ms and 5 %: what is typed arrives, and so does the answer.
# shellcheck source=tests/e2e/programs/lib.sh
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh" "$1" mosh-server mosh-client script

export LC_ALL=C.UTF-8 TERM=xterm
# shellcheck disable=SC2016 # the shell of the session expands it
mosh-server new -i 127.0.0.1 -p 60001 -- bash -c 'echo asks; read -r line; echo "got $((line * 2))"
    sleep 2' >server.log 2>server.err || fail "mosh-server: $?"
key=$(sed -n 's/^MOSH CONNECT 60001 //p' server.log)
[[ -n $key ]] || fail "no key of mosh-server"
stand_between 60001
# An end of the input would end the session. A terminal without a size shows nothing.
mkfifo keys
exec 3<>keys
MOSH_KEY=$key timeout 60 script -qefc "stty cols 80 rows 24; mosh-client 127.0.0.1 $port" \
    typescript <keys >client.log 2>client.err &
await asks typescript
echo 2121 >&3
await 'got 4242' typescript
await 'exiting' typescript
end_between
echo passed
