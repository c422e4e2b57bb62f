#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# What Wireshark shows of messages, against expected.txt. SCRIPT is the dissector. With
# HAPNET_WRITE_GOLDEN=1 the file is written anew.
set -euo pipefail
script=$1
here=$(dirname "$0")
for program in text2pcap tshark; do
    command -v "$program" >/dev/null || { echo "skipped: $program is not installed" && exit 77; }
done
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export TZ=UTC HOME="$folder"
text2pcap -q -t %H:%M:%S.%f -u 7000,7001 "$here/messages.txt" "$folder/messages.pcap" \
    2>"$folder/log" || { cat "$folder/log" && exit 1; }
show() {
    tshark -X "lua_script:$script" -o udp.try_heuristic_first:TRUE -r "$folder/messages.pcap" "$@"
}
{
    show -T fields -E separator=/s \
        -e frame.number -e _ws.col.Protocol -e _ws.col.Info
    show -O hapnet |
        sed -n '/^Hapnet/,/^$/p'
} 2>"$folder/log" >"$folder/shown.txt" || { cat "$folder/log" && exit 1; }
if [[ ${HAPNET_WRITE_GOLDEN:-} == 1 ]]; then
    cp "$folder/shown.txt" "$here/expected.txt"
    exit
fi
diff -u "$here/expected.txt" "$folder/shown.txt"
