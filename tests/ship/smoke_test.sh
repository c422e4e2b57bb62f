#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# The packages hapnet-emulator and libhapnet-link0, made of what is built already, looked at and
# unpacked, and the wheel, which drives the unpacked emulator: in seconds what ship_test.sh does
# with all packages in a bare root.
#   smoke_test.sh REPOSITORY BUILD_DIR WORK_DIR
set -euo pipefail
repository=$(realpath "$1")
build=$(realpath "$2")
rm -rf "$3"
mkdir -p "$3"
work=$(realpath "$3")

fail() {
    echo "smoke_test: $1" >&2
    exit 1
}
for program in dpkg-shlibdeps lintian scdoc; do
    command -v "$program" >/dev/null || { echo "skipped: $program is missing" && exit 77; }
done

cleanup() { cmake -S "$repository" -B "$build" -DHAPNET_PACKAGES=OFF >"$work/after.log"; }
trap cleanup EXIT
cmake -S "$repository" -B "$build" -DHAPNET_PACKAGES=ON >"$work/configure.log"
cmake --build "$build" --target hapnet-emulator hapnet-ctl hapnet_link pages-hapnet-emulator \
    pages-hapnet-ctl changes-hapnet-emulator changes-libhapnet-link0 >"$work/build.log"
cpack --config "$build/CPackConfig.cmake" \
    -D "CPACK_COMPONENTS_ALL=hapnet-emulator;libhapnet-link0" \
    -B "$work/packages" >"$work/cpack.log" || fail "cpack: $(tail -5 "$work/cpack.log")"
lintian --allow-root --fail-on error "$work"/packages/*.deb

for package in "$work"/packages/*.deb; do dpkg-deb -x "$package" "$work/root"; done
"$work/root/usr/bin/hapnet-emulator" --version
"$work/root/usr/bin/hapnet-emulator" predict lte --packets 2000 >"$work/predict.log"
"$work/root/usr/bin/hapnet-emulator" --listen-a 127.0.0.1:0 --listen-b 127.0.0.1:0 --delay 1ms \
    --duration 100ms --stats "$work/run.json" >"$work/run.log" 2>&1
"$work/root/usr/bin/hapnet-emulator" report "$work/run.json" --out "$work/run.html" \
    2>>"$work/run.log"
grep -q 'id="hapnet-data"' "$work/run.html" || fail "the page of a run carries no data"
for page in hapnet-emulator hapnet-ctl; do
    gzip -t "$work/root/usr/share/man/man1/$page.1.gz"
    bash -n "$work/root/usr/share/bash-completion/completions/$page"
done
[[ -s $work/root/lib/systemd/system/hapnet-emulator.service ]] ||
    [[ -s $work/root/usr/lib/systemd/system/hapnet-emulator.service ]] || fail "no unit of systemd"
library=$(find "$work/root" -name libhapnet-link.so.0)
LD_LIBRARY_PATH=$(dirname "$library") PYTHONPATH=$repository/python PYTHONDONTWRITEBYTECODE=1 \
    HAPNET_BIN='' python3 -c '
from hapnet.link import UP, Link
with Link("up.delay = \"5ms\"") as link:
    link.push(UP, b"hello", now=1.0)
    assert link.next_deadline() == 1.005, link.next_deadline()' || fail "libhapnet-link0"
needs=$(dpkg-deb -f "$work"/packages/hapnet-emulator_*.deb Depends)
[[ $needs != *libusb* && $needs != *libhidapi* ]] || fail "it needs libraries of devices: $needs"
echo "smoke_test: $(basename "$work"/packages/hapnet-emulator_*.deb) needs $needs"

if dpkg-query -W python3-pip python3-setuptools python3-wheel >"$work/python.log" 2>&1; then
    # shellcheck source=scripts/lib/wheel.sh
    . "$repository/scripts/lib/wheel.sh"
    make_wheel "$repository" "$work/wheel"
    # shellcheck source=tests/ship/wheel.sh
    . "$repository/tests/ship/wheel.sh"
    try_wheel "$work"/wheel/hapnet-*.whl "$work/root/usr/bin" "$work/venv"
else
    echo "smoke_test: no wheel: $(head -1 "$work/python.log") (scripts/setup.sh --package)"
fi
