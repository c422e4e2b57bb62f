#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Makes the pictures of pages in docs/images.
set -euo pipefail

usage="usage: scripts/live_pictures.sh
Takes pictures with Chromium of what build/release shows, in docs/images: live.png of the demo of
hapnet-web, live-worlds.png, in which both worlds move (an animated PNG), report.png of a report
that hapnet-lab makes of Table 1, and session.png and run.png of the pages of a session over the
emulator and of its run. Exits 3 when hapnet-web, node, chromium or the browser's driver (npm ci in
tests/web) are missing, 1 when a picture has 350 kB, or the animated one 1 MB, or more."

case ${1-} in
'') ;;
-h | --help) echo "$usage" && exit 0 ;;
*) echo "live_pictures: unknown argument '$1'"$'\n'"$usage" >&2 && exit 2 ;;
esac
cd "$(dirname "${BASH_SOURCE[0]}")/.."
command -v node >/dev/null || { echo "live_pictures: node is missing" >&2 && exit 3; }
mkdir -p docs/images
still=docs/images/live.png animated=docs/images/live-worlds.png report=docs/images/report.png
session=docs/images/session.png run=docs/images/run.png
node tests/web/picture.mjs "$still" "$animated" "$report" "$session" "$run"

# check FILE BYTES: prints the file's size, and fails if it exceeds BYTES.
check() {
    local size
    size=$(stat -c %s "$1")
    ((size < $2)) || { echo "live_pictures: $1 has $size bytes" >&2 && exit 1; }
    echo "$1: $size bytes"
}
check "$still" 300000
check "$animated" 1000000
for picture in "$report" "$session" "$run"; do check "$picture" 350000; done
