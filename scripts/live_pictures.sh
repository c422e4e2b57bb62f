#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Makes docs/images/live.png, the picture of the live page, from a running demo.
set -euo pipefail

usage="usage: scripts/live_pictures.sh
Starts the hapnet-web of build/release with its demo and takes the picture docs/images/live.png with
Chromium. Exits 3 when hapnet-web, node, chromium or the page's modules (npm ci in web/page) are
missing, 1 when the picture has 300 kB or more."

case ${1-} in
'') ;;
-h | --help) echo "$usage" && exit 0 ;;
*) echo "live_pictures: unknown argument '$1'"$'\n'"$usage" >&2 && exit 2 ;;
esac
cd "$(dirname "${BASH_SOURCE[0]}")/.."
command -v node >/dev/null || { echo "live_pictures: node is missing" >&2 && exit 3; }
mkdir -p docs/images
picture=docs/images/live.png
node tests/web/picture.mjs "$picture"
size=$(stat -c %s "$picture")
((size < 300000)) || { echo "live_pictures: $picture has $size bytes" >&2 && exit 1; }
echo "$picture: $size bytes"
