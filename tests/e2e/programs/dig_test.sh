#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Ten dig at a time through --upstream, over 80 ms and 5 %: ten answers, each its own.
# shellcheck source=tests/e2e/programs/lib.sh
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh" "$1" dig python3

# Answers every question with 192.0.2.N for the name nN.
cat >server.py <<'END'
import re, socket
s = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
s.bind(("127.0.0.1", 5353))
print("listens", flush=True)
while True:
    q, who = s.recvfrom(4096)
    end = q.index(0, 12) + 5
    n = int(re.match(rb"n(\d+)$", q[13:13 + q[12]]).group(1))
    s.sendto(q[:2] + b"\x84\x00" + q[4:6] + b"\0\1\0\0\0\0" + q[12:end] +
             b"\xc0\x0c\0\1\0\1\0\0\0\0\0\4" + bytes([192, 0, 2, n]), who)
END
python3 server.py >server.log 2>server.err &
await listens server.log
stand_between 5353
digs=()
for n in {1..10}; do
    dig @127.0.0.1 -p "$port" +short +tries=8 +time=1 +noedns "n$n.example" A >"answer$n.log" &
    digs+=($!)
done
wait "${digs[@]}"
for n in {1..10}; do
    grep -qx "192.0.2.$n" "answer$n.log" || fail "no answer for n$n"
done
end_between
jq -e '.up.received >= 10 and .clients_seen >= 10' stats.json >said.log ||
    fail "fewer than ten clients"
echo passed
