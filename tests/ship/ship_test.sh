#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# The packages as a stranger gets them: made, looked at by lintian, installed in a bare Debian 12
# root, tried, and removed without a trace. As root.
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

complaints=$(systemd-analyze verify "$repository"/packaging/systemd/*.service 2>&1 |
    grep "/packaging/" | grep -v "is not executable: No such file" || true)
[[ -z $complaints ]] || fail "systemd-analyze verify: $complaints"

root=$work/root
cleanup() {
    mountpoint -q "$root/proc" && umount "$root/proc"
    rm -rf "$root"
}
trap cleanup EXIT
rm -rf "$root"
debootstrap --variant=minbase bookworm "$root" >"$work/debootstrap.log" 2>&1 ||
    fail "no bare root: $(tail -3 "$work/debootstrap.log")"
cp /etc/apt/sources.list "$root/etc/apt/" 2>/dev/null || true
cp -r /etc/apt/sources.list.d /etc/apt/apt.conf.d "$root/etc/apt/" 2>/dev/null || true
cp /etc/resolv.conf "$root/etc/" 2>/dev/null || true
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
# The README's first example: a service that answers, and the emulator before it.
inside sh -c 'timeout -s INT 6 hapnet-emulator probe --answer 127.0.0.1:7100 & sleep 0.5
    hapnet-emulator --listen 127.0.0.1:7101 --upstream 127.0.0.1:7100 --delay 40ms --duration 5s &
    sleep 0.5; hapnet-emulator probe 127.0.0.1:7101 --count 20 --rate 20; wait' |
    tee "$work/first.log"
grep -q "20 sent" "$work/first.log" || fail "the first example did not ask 20 times"
echo "ship_test: installed and tried in $((SECONDS - begin)) s"
for file in man/man1/hapnet-emulator.1.gz bash-completion/completions/hapnet-ctl; do
    [[ -s $root/usr/share/$file ]] || fail "$file is not there"
done
inside sh -c 'apt-get -q -y purge hapnet-emulator' >>"$work/apt.log" 2>&1
left=$(inside find / -xdev -iname '*hapnet*' -not -path '/root/*' -not -path '/var/log/*' \
    -not -path '/var/cache/*')
[[ -z $left ]] || fail "left behind: $left"
echo "ship_test: removed without a trace"
