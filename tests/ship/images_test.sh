#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# The Dockerfiles, built with buildah on a bare Debian 12 of our own instead of a registry's image,
# and each image's program run in it. Says why where it cannot be done, and exits 77.
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
for role in emulator peer lab; do
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
