#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# scripts/demo.sh --web gives a browser the address of the page without showing its token to other
# users: not as an argument, and in a file that only this user can read. The programs are doubles.
# Usage: demo_web_test.sh SCRIPT FOLDER-WITH-THE-PROGRAMS
set -euo pipefail
# shellcheck source=tests/e2e/script_lib.sh
. "$(dirname "${BASH_SOURCE[0]}")/script_lib.sh"

token=0123456789abcdef0123456789abcdef
mkdir "$out/bin"
cat >"$out/bin/hapnet-web" <<'END'
#!/usr/bin/env bash
while (($# > 0)); do
    [[ $1 != --url-file ]] || (umask 077 && echo "http://127.0.0.1:9/#t=$TOKEN" >"$2")
    shift
done
trap 'exit 0' TERM
for _ in {1..200}; do sleep 0.1; done
END
cat >"$out/bin/xdg-open" <<'END'
#!/usr/bin/env bash
{ echo "$#" && stat -c %a "$1" && stat -c %a "$(dirname "$1")" && cat "$1"; } >"$TOLD.new"
echo "$@" >"$TOLD.words"
mv "$TOLD.new" "$TOLD"
END
chmod +x "$out"/bin/*

umask 022
TOKEN=$token TOLD=$out/told DISPLAY=:9 PATH=$out/bin:$PATH \
    "$script" --web --programs "$out/bin" --out "$out/results" >"$out/said" 2>&1 &
demo=$!
for _ in {1..200}; do
    [[ ! -s $out/told ]] || break
    sleep 0.1
done
kill -TERM "$demo"
wait "$demo" || fail "demo.sh --web ends with $?: $(<"$out/said")"
[[ -s $out/told ]] || fail "no browser was asked: $(<"$out/said")"
{ read -r words && read -r file && read -r folder && read -r page; } <"$out/told"
((words == 1)) || fail "xdg-open got $words words"
! grep -q "$token" "$out/told.words" || fail "the token is in the arguments"
[[ $file == 600 ]] || fail "the file has mode $file"
[[ $folder == 700 ]] || fail "its folder has mode $folder"
[[ $page == *"url=http://127.0.0.1:9/#t=$token"* ]] || fail "the file leads to: $page"
! grep -rq "$token" "$out/results" || fail "the token stays in the results"
