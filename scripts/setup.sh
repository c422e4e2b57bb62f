#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Installs what is missing to build Hapnet on Debian 12 and, with --test, to test it.
set -euo pipefail

usage="usage: scripts/setup.sh [--test] [--programs] [--web] [--package] [--ship] [--fleet]
                        [--figures]
       scripts/setup.sh --only emulator [--package]
Installs the Debian 12 packages that building Hapnet needs and that are missing, or with --only
emulator those that building the emulator alone needs; with --test
also those that scripts/test.sh needs, with --programs, --web (nodejs and npm only where there is no
node), --ship and --fleet those that its kinds of these names need, with --package those that
scripts/package.sh needs, with --figures matplotlib, with which scripts/plot.py draws. Runs as root
or with sudo, asks nothing, and does nothing when nothing is missing."

emulator_packages=(g++ cmake jq ninja-build libboost-dev libexpected-dev
    librandom123-dev libreaderwriterqueue-dev libspdlog-dev libtomlplusplus-dev nlohmann-json3-dev)
packages=("${emulator_packages[@]}" libglm-dev libhidapi-dev libjs-three libsodium-dev
    libusb-1.0-0-dev pkg-config)
test_packages=(clang-14 clang-format-14 clang-tidy-14 curl iperf3 iputils-ping libbenchmark-dev
    libbullet-dev libclang-rt-14-dev libgtest-dev libmujoco-dev libode-dev libumockdev-dev lld-14
    parallel passt python3-dissononce python3-jsonschema python3-numpy python3-pandas python3-pytest
    python3-transitions shellcheck slirp4netns tshark umockdev valgrind)

# Other people's programs, which run through the emulator.
program_packages=(bind9-dnsutils bsdutils curl iperf iperf3 iputils-ping mosh ngtcp2-client
    ngtcp2-server openssl passt python3 slirp4netns)

# A node that did not come from Debian has its own npm, and Debian's would not go with it.
# Of prometheus only promtool is used.
web_packages=(chromium prometheus tshark)
command -v node >/dev/null && command -v npm >/dev/null || web_packages+=(nodejs npm)
# Programs that run the shards of a plan, and a cluster of one node.
fleet_packages=(munge openssh-client openssh-server parallel procps rsync slurm-wlm)

package_packages=(binutils debootstrap dpkg-dev gzip libudev-dev lintian python3-pip
    python3-setuptools python3-wheel scdoc systemd)

# Programs that build the images and play the compose file, and the shells with completions.
ship_packages=(buildah fish iproute2 jq mmdebstrap python3-yaml zsh)

if [[ ${1-} == --only ]]; then
    case ${*:2} in
    emulator) packages=("${emulator_packages[@]}") ;;
    'emulator --package')
        packages=("${emulator_packages[@]}" binutils dpkg-dev file gzip scdoc)
        ;;
    *) echo "setup: --only takes 'emulator', then perhaps '--package'"$'\n'"$usage" >&2 && exit 2 ;;
    esac
    set --
fi
for argument in "$@"; do
    case $argument in
    --test) packages+=("${test_packages[@]}") ;;
    --programs) packages+=("${program_packages[@]}") ;;
    --web) packages+=("${web_packages[@]}") ;;
    --fleet) packages+=("${fleet_packages[@]}") ;;
    --ship) packages+=("${ship_packages[@]}") ;;
    --figures) packages+=(python3-matplotlib) ;;
    --package) packages+=("${package_packages[@]}") ;;
    -h | --help) echo "$usage" && exit 0 ;;
    *) echo "setup: unknown argument '$argument'"$'\n'"$usage" >&2 && exit 2 ;;
    esac
done

environment_error() {
    printf 'setup: %s\n' "$@" >&2
    exit 3
}

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    environment_error "this is not Debian. Install what these Debian 12 packages hold," \
        "then build with 'cmake --workflow --preset release':" "${packages[*]}"
fi

# shellcheck disable=SC2016 # dpkg-query expands these, not the shell
format='${Package} ${db:Status-Status}\n'
installed=$(dpkg-query -W -f "$format" "${packages[@]}" 2>/dev/null || true)
missing=()
for package in "${packages[@]}"; do
    grep -qxF "$package installed" <<<"$installed" || missing+=("$package")
done
((${#missing[@]} > 0)) || exit 0

install="apt-get install --no-install-recommends ${missing[*]}"
if ((EUID == 0)); then
    as_root=(env DEBIAN_FRONTEND=noninteractive)
elif command -v sudo >/dev/null && { [[ -t 0 ]] || sudo -n true 2>/dev/null; }; then
    as_root=(sudo env DEBIAN_FRONTEND=noninteractive)
else
    environment_error "installing needs root, and sudo is not there or wants a password." \
        "Ask an administrator to run: $install"
fi

echo "setup: installing ${missing[*]}"
apt=("${as_root[@]}" apt-get -q -y -o DPkg::Lock::Timeout=120)
"${apt[@]}" update || environment_error "'apt-get update' failed (see above)." \
    "Check the network and /etc/apt, then run this again."
"${apt[@]}" install --no-install-recommends "${missing[@]}" ||
    environment_error "installing failed (see above). These are packages of Debian 12;" \
        "when that is cured, run this again, or: $install"
