#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Makes packages for Debian 12, a tarball, a wheel for Python, and their sums.
set -euo pipefail

usage="usage: scripts/package.sh --out DIR [--only emulator]
Installs what is missing, builds the programs, and leaves in DIR the packages hapnet-emulator (with
hapnet-ctl and no library of devices) and hapnet (hapnet-peer, hapnet-lab), each with manual pages,
completions for bash, zsh and fish, and a unit of systemd; hapnet-web; libhapnet-link0 (a
path of the emulator for C); hapnet-dev (headers, and libraries for C++) and python3-hapnet; a
tarball of the programs that runs from any folder and needs no package; a wheel of the module for
Python; and SHA256SUMS of all of them.
--only emulator makes the first package alone, a tarball with its programs, and SHA256SUMS.
Install them with: apt-get install ./DIR/hapnet-emulator_*.deb
Exits 0 when they are there, 1 when something failed, 2 for an unknown argument, 3 when something
that it needs cannot be installed."

refuse() {
    echo "package: $1"$'\n'"$usage" >&2
    exit 2
}

out=
only=
while (($# > 0)); do
    case $1 in
    --out)
        [[ -n ${2-} ]] || refuse "--out: which folder?"
        out=$2 && shift 2
        ;;
    --only)
        [[ ${2-} == emulator ]] || refuse "--only: emulator"
        only=emulator && shift 2
        ;;
    -h | --help) echo "$usage" && exit 0 ;;
    *) refuse "unknown argument '$1'" ;;
    esac
done
[[ -n $out ]] || refuse "--out is required: where the packages go"
mkdir -p "$out"
out=$(realpath "$out")

cd "$(dirname "${BASH_SOURCE[0]}")/.."
scripts/setup.sh ${only:+--only "$only"} --package
build=build/package${only:+-$only}
libdir=lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH)
# make OPTION...: configures and builds.
make() {
    cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON \
        -DHAPNET_PRECOMPILED=ON -DHAPNET_TESTS=OFF -DHAPNET_PACKAGES=ON -DHAPNET_ONLY="$only" \
        -DHAPNET_WEB="$([[ -n $only ]] && echo OFF || echo ON)" \
        -DCMAKE_INSTALL_PREFIX=/usr -DCMAKE_INSTALL_LIBDIR="$libdir" "$@"
    cmake --build "$build" --parallel "$(nproc)"
}
make -DHAPNET_STATIC=OFF
rm -rf "$build/packages"
cpack --config "$build/CPackConfig.cmake" -B "$build/packages"
rm -f "$out"/{hapnet,hapnet-emulator,hapnet-web,hapnet-dev,libhapnet-link0,python3-hapnet}_*.deb \
    "$out"/hapnet-*.tar.gz "$out"/hapnet-*.whl "$out/SHA256SUMS"
cp "$build"/packages/*.deb "$out"

# The same objects, linked with archives.
make -DHAPNET_STATIC=ON
version=$(sed -n 's/^CMAKE_PROJECT_VERSION:[^=]*=//p' "$build/CMakeCache.txt")
name=hapnet${only:+-$only}-$version-linux-$(uname -m)
rm -rf "$build/tarball"
components=(hapnet-emulator)
[[ -n $only ]] || components+=(hapnet hapnet-web)
for component in "${components[@]}"; do
    cmake --install "$build" --component "$component" --prefix "$build/tarball/$name" --strip
done
cp README.md LICENSE CHANGELOG.md "$build/tarball/$name"
# The programs of the tarball contain libraries of others: their notices, as Debian states them.
linked=(libboost1.74-dev libexpected-dev libfmt-dev libgcc-12-dev librandom123-dev
    libreaderwriterqueue-dev libspdlog-dev libstdc++-12-dev libtomlplusplus-dev nlohmann-json3-dev)
[[ -n $only ]] || linked+=(libglm-dev libhidapi-dev libsodium-dev libusb-1.0-0-dev)
notices=$build/tarball/$name/share/doc/hapnet/linked
mkdir -p "$notices"
for package in "${linked[@]}"; do
    cp -L "/usr/share/doc/$package/copyright" "$notices/$package"
done
cp -L /usr/share/common-licenses/{Apache-2.0,GPL-3,LGPL-2.1} "$notices"
{
    printf '%s\n' "The programs of this folder hold archives of these packages of Debian 12." \
        "Each file here is the notice of one of them; the licences that they name are beside." \
        "libusb is under the LGPL 2.1: to use another version of it, install that and run" \
        "scripts/package.sh of Hapnet $version, whose source is public. Debian has its source." ""
    dpkg-query -W -f '${Package} ${Version}\n' "${linked[@]}"
} >"$notices/README"
tar -C "$build/tarball" --sort=name --owner=0 --group=0 --numeric-owner -czf "$out/$name.tar.gz" \
    "$name"
made=("$name.tar.gz")

if [[ -z $only ]]; then
    # shellcheck source=scripts/lib/wheel.sh
    . scripts/lib/wheel.sh
    make_wheel . "$build/wheel"
    cp "$build"/wheel/hapnet-*.whl "$out"
    made+=("$(basename "$build"/wheel/hapnet-*.whl)")
fi
for package in "$build"/packages/*.deb; do made+=("${package##*/}"); done
(cd "$out" && sha256sum "${made[@]}" >SHA256SUMS)
printf 'package: %s\n' "${made[@]/#/$out/}" "$out/SHA256SUMS"
