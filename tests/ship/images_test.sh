#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# The Dockerfiles, built with buildah on a bare Debian 12 of our own instead of a registry's image,
# each image's program run in it, the page of hapnet-web asked for, and the services of the compose
# file played (compose_test.sh). Says why where it cannot be done, and exits 77.
#   images_test.sh REPOSITORY PACKAGES WORK_DIR
set -euo pipefail
repository=$(realpath "$1")
packages=$(realpath "$2")
mkdir -p "$3"
work=$(realpath "$3")

fail() {
    echo "images_test: $1" >&2
    exit 1
}
skip() {
    echo "skipped: $1" && exit 77
}
for program in buildah mmdebstrap; do
    command -v "$program" >/dev/null || skip "$program is not installed (Debian: $program)"
done
((EUID == 0)) || unshare --user --map-root-user true 2>/dev/null ||
    skip "this user may not make user namespaces"

export STORAGE_DRIVER=vfs BUILDAH_ISOLATION=chroot
storage=(--root "$work/storage" --runroot "$work/run")
cleanup() {
    buildah "${storage[@]}" rm --all >/dev/null 2>&1 || true
    rm -rf "$work/storage" "$work/run" "$work/context" "$work/base.tar"
}
trap cleanup EXIT
cleanup
mmdebstrap --variant=minbase bookworm "$work/base.tar" >"$work/base.log" 2>&1 ||
    fail "no base: $(tail -3 "$work/base.log")"
base=$(buildah "${storage[@]}" from scratch 2>"$work/from.log") ||
    skip "buildah makes no container here: $(tail -1 "$work/from.log")"
buildah "${storage[@]}" add -q "$base" "$work/base.tar" / >/dev/null
buildah "${storage[@]}" commit -q "$base" localhost/hapnet-base >/dev/null

mkdir -p "$work/context/packages"
cp "$packages"/*.deb "$work/context/packages/"
for role in emulator peer lab web; do
    begin=$SECONDS
    buildah "${storage[@]}" build --network host --build-arg BASE=localhost/hapnet-base \
        -f "$repository/packaging/docker/$role.Dockerfile" -t "localhost/hapnet-$role" \
        "$work/context" >"$work/$role.log" 2>&1 ||
        fail "$role.Dockerfile: $(tail -5 "$work/$role.log")"
    made=$(buildah "${storage[@]}" from "localhost/hapnet-$role")
    said=$(buildah "${storage[@]}" run "$made" -- "hapnet-$role" --version | head -1)
    user=$(buildah "${storage[@]}" run "$made" -- id -un)
    [[ $said == "hapnet-$role "* && $user == nobody ]] ||
        fail "the image of $role says '$said' as $user"
    entry=$(buildah "${storage[@]}" inspect --format '{{.OCIv1.Config.Entrypoint}}' "$made")
    [[ $entry == "[hapnet-$role]" ]] || fail "the image of $role begins with $entry"
    echo "images_test: $role: $said, built in $((SECONDS - begin)) s"
done

# The page, from the image, as a browser would ask for it.
page=$(buildah "${storage[@]}" from --pull=never localhost/hapnet-web)
buildah "${storage[@]}" run "$page" -- timeout --preserve-status 20 hapnet-web --port 0 \
    >"$work/web.out" 2>"$work/web.err" &
serving=$!
for _ in {1..150}; do
    url=$(sed -n 's/^open //p' "$work/web.out")
    [[ -z $url ]] || break
    sleep 0.1
done
[[ -n $url ]] || fail "hapnet-web in its image: $(cat "$work/web.out" "$work/web.err")"
python3 - "${url%%#*}" <<'PYTHON' || fail "the image of web serves no page"
import sys
import urllib.request

with urllib.request.urlopen(sys.argv[1], timeout=10) as answer:
    page = answer.read().decode()
assert answer.status == 200 and "<title>Hapnet" in page, page[:200]
PYTHON
wait "$serving" || fail "hapnet-web in its image ended with $?: $(cat "$work/web.err")"
echo "images_test: web: the page is served"

composed=0
"$repository/tests/ship/compose_test.sh" "$repository" "$work" "$work/compose" || composed=$?
((composed == 0 || composed == 77)) || fail "the services of the compose file did not play"
