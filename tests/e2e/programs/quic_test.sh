#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# A file over QUIC (HTTP/3, ngtcp2) through a relay, over 80 ms and 5 %: it arrives whole.
PATH=$PATH:/usr/sbin
# shellcheck source=tests/e2e/programs/lib.sh
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh" "$1" gtlsclient gtlsserver openssl

openssl req -x509 -newkey rsa:2048 -nodes -keyout key -out certificate -days 2 \
    -subj /CN=localhost >openssl.log 2>&1 || fail "openssl: $?"
mkdir served got
head -c 100000 /dev/urandom >served/file
gtlsserver --quiet --htdocs="$PWD/served" 127.0.0.1 4433 key certificate >server.log 2>&1 &
stand_between 4433
timeout 40 gtlsclient --quiet --exit-on-all-streams-close --download="$PWD/got" 127.0.0.1 "$port" \
    "https://localhost/file" >client.log 2>&1 || fail "gtlsclient: $?"
cmp served/file got/file || fail "the file has changed on its way"
end_between
jq -e '.up.dropped.random_loss + .down.dropped.random_loss > 0' stats.json >said.log ||
    fail "nothing was lost"
echo passed
