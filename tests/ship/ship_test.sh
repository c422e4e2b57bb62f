#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Tests the packages as a user gets them: made, checked by lintian, installed in a bare Debian 12
# root, tried, and removed without a trace. Needs root.
#   ship_test.sh REPOSITORY WORK_DIR
set -euo pipefail
repository=$1
work=$2
mkdir -p "$work"

fail() {
    echo "ship_test: $1" >&2
    exit 1
}

if ((EUID != 0)); then
    echo "skipped: a bare root can only be made by root" && exit 77
fi
"$repository/scripts/package.sh" --out "$work/packages"
lintian --allow-root --fail-on error,warning "$work"/packages/*.deb

# The tarball needs only the C library, as old as that of Ubuntu 22.04, and libudev for devices.
tar -C "$work" -xzf "$work"/packages/hapnet-*.tar.gz
folder=$(find "$work" -maxdepth 1 -name 'hapnet-*-linux-*' -type d)
newest() {
    objdump -T "$1" | sed -n 's/.*(\?GLIBC_\([0-9.]*\))\? .*/\1/p' | sort -uV | tail -1
}
for program in "$folder"/bin/*; do
    foreign=$(objdump -p "$program" | sed -n 's/ *NEEDED *//p' |
        grep -Ev '^(libc\.so\.6|libm\.so\.6|libudev\.so\.1|ld-linux.*)$' || true)
    [[ -z $foreign ]] || fail "$program needs $foreign"
    [[ $program == */hapnet-peer ]] || ! objdump -p "$program" | grep -q libudev ||
        fail "$program needs libudev"
    version=$(newest "$program")
    [[ -n $version ]] || fail "$program: no version of the C library was found"
    [[ $(printf '%s\n2.35\n' "$version" | sort -V | tail -1) == 2.35 ]] ||
        fail "$program needs GLIBC_$version: $(objdump -T "$program" | grep "GLIBC_$version")"
done
"$folder/bin/hapnet-emulator" --version
# The sums name every file, and the wheel drives the tarball's emulator.
(cd "$work/packages" && sha256sum --quiet --check SHA256SUMS) || fail "SHA256SUMS is wrong"
files=$(find "$work/packages" -type f -not -name SHA256SUMS | wc -l)
(($(wc -l <"$work/packages/SHA256SUMS") == files)) || fail "SHA256SUMS does not name $files files"
# shellcheck source=tests/ship/wheel.sh
. "$repository/tests/ship/wheel.sh"
try_wheel "$work"/packages/hapnet-*.whl "$folder/bin" "$work/venv"
# The libraries linked into it are others' work, under licences that require their texts.
for notice in libusb-1.0-0-dev libhidapi-dev libsodium-dev LGPL-2.1 README; do
    [[ -s $folder/share/doc/hapnet/linked/$notice ]] || fail "the tarball has no notice $notice"
done

# The shell completions and the manual pages of the tarball's programs.
for shell in zsh fish; do
    command -v "$shell" >/dev/null || fail "$shell is missing: scripts/setup.sh --ship installs it"
done
"$repository/tests/e2e/install/install_test.sh" "$folder/bin"

complaints=$(systemd-analyze verify "$repository"/packaging/systemd/*.service 2>&1 |
    grep "/packaging/" | grep -v "is not executable: No such file" || true)
[[ -z $complaints ]] || fail "systemd-analyze verify: $complaints"
declare -A exposures=([hapnet-emulator.service]=13 [hapnet-peer@.service]=17
    [hapnet-web.service]=10)
for unit in "$repository"/packaging/systemd/*.service; do
    systemd-analyze security --offline=true --threshold="${exposures[${unit##*/}]}" "$unit" \
        >"$work/security.log" 2>&1 ||
        fail "systemd-analyze security ${unit##*/}: $(tail -1 "$work/security.log")"
    echo "ship_test: ${unit##*/}: $(sed -n 's/^.* \(Overall exposure.*: [0-9.]*\) .*/\1/p' \
        "$work/security.log")"
done

root=$work/root
cleanup() {
    local place
    for place in "$root" "$root.build"; do
        ! mountpoint -q "$place/proc" || umount "$place/proc"
    done
    rm -rf "$root" "$root.13" "$root.build"
}
trap cleanup EXIT
rm -rf "$root" "$root.13" "$root.build"
debootstrap --variant=minbase bookworm "$root" >"$work/debootstrap.log" 2>&1 ||
    fail "no bare root: $(tail -3 "$work/debootstrap.log")"
cp /etc/apt/sources.list "$root/etc/apt/" 2>/dev/null || true
cp -r /etc/apt/sources.list.d /etc/apt/apt.conf.d "$root/etc/apt/" 2>/dev/null || true
cp /etc/resolv.conf "$root/etc/" 2>/dev/null || true
cp -a --reflink=auto "$root" "$root.build"
mount -t proc proc "$root/proc"
inside() {
    chroot "$root" env DEBIAN_FRONTEND=noninteractive PATH=/usr/sbin:/usr/bin:/sbin:/bin "$@"
}
inside apt-get -q update >"$work/apt.log" 2>&1 || fail "apt-get update: $(tail -3 "$work/apt.log")"

cp "$work"/packages/*.deb "$root/root/"
begin=$SECONDS
inside sh -c 'apt-get -q -y install --no-install-recommends /root/hapnet-emulator_*.deb' \
    >>"$work/apt.log" 2>&1 || fail "installing: $(tail -5 "$work/apt.log")"
inside hapnet-emulator --version
# The README's first example, unchanged: its build/release/bin leads to the package's programs.
mkdir -p "$root/root/clone/build/release"
ln -s /usr/bin "$root/root/clone/build/release/bin"
awk '
    /^<!-- not run by readme_test: / { left_out = 1; next }
    /^```sh$/ && !left_out { wanted = 1; next }
    /^```/ { if (wanted) exit; left_out = 0 }
    wanted' "$repository/README.md" >"$root/root/clone/first.sh"
inside sh -c 'cd /root/clone && bash -eu first.sh' | tee "$work/first.log"
grep -q "^40 sent" "$work/first.log" || fail "the README's first example did not ask 40 times"
echo "ship_test: installed and tried in $((SECONDS - begin)) s"
for file in man/man1/hapnet-emulator.1.gz bash-completion/completions/hapnet-ctl; do
    [[ -s $root/usr/share/$file ]] || fail "$file is not there"
done
# nothing_left PACKAGE...: expects that they are removed without a trace.
nothing_left() {
    inside apt-get -q -y purge "$@" >>"$work/apt.log" 2>&1
    local left
    left=$(inside find / -xdev -iname '*hapnet*' -not -path '/root/*' -not -path '/var/log/*' \
        -not -path '/var/cache/*')
    [[ -z $left ]] || fail "left behind by $*: $left"
    echo "ship_test: $*: removed without a trace"
}
nothing_left hapnet-emulator

# The emulator alone, built in another bare root as docs/use/build.md says, with what it installs.
mkdir "$root.build/root/clone"
git -c safe.directory='*' -C "$repository" ls-files -z |
    tar -C "$repository" --null --ignore-failed-read -T - -c |
    tar -C "$root.build/root/clone" -x || fail "the sources are no clone"
awk '
    /^<!-- not run by readme_test: .* scripts\/test.sh ship does it / { meant = 1; next }
    /^```sh$/ && meant { wanted = 1; next }
    /^```/ { if (wanted) exit }
    wanted' "$repository/docs/use/build.md" >"$root.build/root/clone/emulator.sh"
begin=$SECONDS
mount -t proc proc "$root.build/proc"
chroot "$root.build" env DEBIAN_FRONTEND=noninteractive PATH=/usr/sbin:/usr/bin:/sbin:/bin \
    sh -eu -c 'apt-get -q update && cd /root/clone && sh -eux emulator.sh' \
    >"$work/emulator.log" 2>&1 || fail "the emulator alone: $(tail -5 "$work/emulator.log")"
grep '^hapnet-emulator [0-9]' "$work/emulator.log" ||
    fail "the emulator alone: $(tail -1 "$work/emulator.log")"
# The page of a run belongs to it.
alone=$(cd "$root.build" && find root/clone -path '*/bin/hapnet-emulator' -type f | head -1)
chroot "$root.build" "/$alone" --listen-a 127.0.0.1:0 --listen-b 127.0.0.1:0 --delay 1ms \
    --duration 100ms --stats /root/run.json >>"$work/emulator.log" 2>&1
chroot "$root.build" "/$alone" report /root/run.json --out /root/run.html 2>>"$work/emulator.log"
grep -q 'import("hapnet/report/report.js")' "$root.build/root/run.html" ||
    fail "the emulator alone has no page of a run that is drawn"
umount "$root.build/proc"
rm -rf "$root.build"
echo "ship_test: the emulator alone was built in $((SECONDS - begin)) s"

# The tarball runs where no package of ours is installed.
cp -r "$folder" "$root/root/"
inside "/root/${folder##*/}/bin/hapnet-emulator" --version
inside "/root/${folder##*/}/bin/hapnet-lab" --version

# Then the others, together.
inside sh -c 'apt-get -q -y install --no-install-recommends /root/*.deb' >>"$work/apt.log" 2>&1 ||
    fail "installing all: $(tail -5 "$work/apt.log")"
inside hapnet-peer doctor || (($? == 1)) || fail "hapnet-peer doctor"
inside hapnet-lab list >"$work/experiments.log" || fail "hapnet-lab list"
inside python3 -c '
import hapnet
with hapnet.Emulator(delay="5ms") as network:
    print("from Python:", network.address_a, network.stats()["valid"])' ||
    fail "python3-hapnet does not drive the emulator"
inside python3 -c '
from hapnet.link import UP, Link
with Link("lte", seed=1) as link:
    link.push(UP, b"hello", now=0.0)
    print("through the library:", link.pop(now=9.0))' ||
    fail "python3-hapnet does not find libhapnet-link0"
inside hapnet-study --version || fail "python3-hapnet brings no hapnet-study"
inside test -s /usr/include/hapnet_link.h || fail "hapnet-dev has no hapnet_link.h"
grep -q three.module.min.js "$root/usr/bin/hapnet-web" ||
    fail "the page of hapnet-web has no modules"
inside test -s /usr/include/hapnet/algorithm.h || fail "hapnet-dev has no hapnet/algorithm.h"
inside hapnet-web --version
nothing_left hapnet hapnet-emulator hapnet-web hapnet-dev libhapnet-link0 python3-hapnet

# The Dockerfiles, where images can be made.
images=0
"$repository/tests/ship/images_test.sh" "$repository" "$work/packages" "$work/images" || images=$?
((images == 0 || images == 77)) || fail "the images were not made"

# Debian 13, where it can be had.
if debootstrap --variant=minbase trixie "$root.13" >"$work/debootstrap-13.log" 2>&1; then
    cp -r "$folder" "$root.13/root/"
    chroot "$root.13" "/root/${folder##*/}/bin/hapnet-emulator" --version ||
        fail "the tarball does not run on Debian 13"
    echo "ship_test: the tarball runs on Debian 13"
else
    echo "ship_test: no Debian 13 here: the tarball was not tried on it" \
        "($(tail -1 "$work/debootstrap-13.log"))"
fi
