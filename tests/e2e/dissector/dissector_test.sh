#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Compares Wireshark's view of messages and their fates with expected.txt. SCRIPT is the dissector.
# With HAPNET_WRITE_GOLDEN=1 the file is rewritten.
set -euo pipefail
script=$1
here=$(dirname "$0")
for program in text2pcap editcap tshark; do
    command -v "$program" >/dev/null || { echo "skipped: $program is not installed" && exit 77; }
done
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export TZ=UTC HOME="$folder"
text2pcap -q -t %H:%M:%S.%f -u 7000,7001 "$here/messages.txt" "$folder/messages.pcap" \
    2>"$folder/log" || { cat "$folder/log" && exit 1; }
# Comments as the emulator writes them on arrivals and departures; the last one is a person's.
fates=("delayed 163.2 ms, copied, 2 bits corrupted, displaced" "dropped: gilbert-elliott"
    "late 7 us" "late 12 us, copy" "delayed 250 us" "delayed 1.0 ms, 1 bit corrupted" "looks odd")
comments=()
for i in "${!fates[@]}"; do comments+=(-a "$((i + 1)):${fates[i]}"); done
editcap "${comments[@]}" "$folder/messages.pcap" "$folder/messages.pcapng" \
    2>"$folder/log" || { cat "$folder/log" && exit 1; }
show() {
    tshark -X "lua_script:$script" -o udp.try_heuristic_first:TRUE -r "$folder/messages.pcapng" "$@"
}
{
    show -T fields -E separator=/s \
        -e frame.number -e _ws.col.Protocol -e _ws.col.Info
    show -T fields -E separator=, -e frame.number -e hapnet.fate -e hapnet.cause \
        -e hapnet.delay_ms -e hapnet.copied -e hapnet.corrupted_bits -e hapnet.displaced \
        -e hapnet.late_us -e hapnet.copy
    show -T fields -e frame.number -Y 'hapnet.delay_ms < 2'
    show -O hapnet |
        sed -n '/^Hapnet/,/^$/p'
} 2>"$folder/log" >"$folder/shown.txt" || { cat "$folder/log" && exit 1; }
if [[ ${HAPNET_WRITE_GOLDEN:-} == 1 ]]; then
    cp "$folder/shown.txt" "$here/expected.txt"
    exit
fi
diff -u "$here/expected.txt" "$folder/shown.txt"
