#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# No process that a command of between starts outlives the emulator, also when it is killed, nested,
# or where the system refuses PID namespaces. Terminals, users and exit codes are for the commands
# as they are outside.
# Usage: processes_test.sh FOLDER-WITH-THE-PROGRAMS
set -euo pipefail

emulator=$(realpath "$1")/hapnet-emulator
for tool in unshare mount script ps; do
    command -v "$tool" >/dev/null || { echo "skipped: there is no $tool" && exit 77; }
done
code=0
"$emulator" between -- true --- true >/dev/null 2>&1 || code=$?
((code != 3)) || { echo "skipped: no networks of one's own here" && exit 77; }

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# A number that occurs in the words of no other process.
mark=7$$

# listed START...: the ids of the processes whose words begin with one of these, oldest first,
# zombies not counted.
listed() {
    local pid stat words start
    while read -r pid stat words; do
        for start in "$@"; do
            [[ $stat == Z* || $words != "$start"* ]] || echo "$pid"
        done
    done < <(ps -e --sort=start_time -o pid=,stat=,args=)
}
processes() { listed "sleep $mark" | wc -l; }

fail() {
    echo "FAILED: $1" >&2
    tail -n 20 "$folder"/{out,err} >&2
    # shellcheck disable=SC2046 # several ids
    kill -KILL $(listed "sleep $mark") 2>/dev/null || true
    exit 1
}

# Ways to start the emulator: as it is; where the system grants no PID namespace; and where it
# grants one, and no /proc for it, as in a container that hides parts of it.
plain() { "$@"; }
no_pid_namespace() {
    unshare --user --map-root-user sh -c 'echo 0 >/proc/sys/user/max_pid_namespaces && exec "$@"' \
        sh "$@"
}
hidden_proc() {
    # shellcheck disable=SC2016 # the inner shell expands it
    unshare --user --map-root-user --mount sh -c '
        while read -r _ place type _; do
            [ "$type" != proc ] || mount --bind /dev/null "$place/uptime"
        done </proc/mounts
        exec unshare --user --map-root-user "$@"' sh "$@"
}

# kill_emulator WORDS: kills the one whose first command has these words. Its inits have them, too.
kill_emulator() {
    local all
    readarray -t all < <(listed "$emulator between -- sh -c $1")
    ((${#all[@]} > 0)) || fail "there is no emulator"
    kill -KILL "${all[0]}"
}
# await_processes COUNT WHY
await_processes() {
    for _ in {1..400}; do
        (($(processes) != $1)) || return 0
        sleep 0.05
    done
    fail "$2: there are $(processes) processes, not $1"
}

# Four processes: two of each command, one of them in a session of its own.
family="setsid sh -c 'sleep $mark.1; :' & sleep $mark.2; :"
nested="exec $emulator between -- sh -c \"setsid sleep $mark.3 & sleep $mark.4\" --- sleep $mark.5"

# survives_nothing WAY
survives_nothing() {
    local way=$1 code
    "$way" "$emulator" between -- sh -c "$family" --- sh -c "$family" >"$folder/out" \
        2>"$folder/err" &
    await_processes 4 "$way"
    kill_emulator setsid
    await_processes 0 "$way, killed"
    wait

    # Both ends of the outer wire hold another emulator.
    "$way" "$emulator" between -- sh -c "$nested" --- sh -c "$nested" >"$folder/out" \
        2>"$folder/err" &
    await_processes 6 "$way, nested"
    kill_emulator exec
    await_processes 0 "$way, nested, killed"
    wait

    # Three commands, of which two hold another emulator with three.
    local three="exec $emulator between -- sleep $mark.3 --- sleep $mark.4 --- setsid sleep $mark.5"
    "$way" "$emulator" between -- sh -c "$three" --- sh -c "$three" --- sh -c "$family" \
        >"$folder/out" 2>"$folder/err" &
    await_processes 8 "$way, three"
    kill_emulator exec
    await_processes 0 "$way, three, killed"
    wait

    # A process that a command leaves in the background ends with the run.
    code=0
    "$way" "$emulator" between -- sh -c "setsid sleep $mark.6 & sleep 0.3; exit 4" --- \
        sh -c "setsid sleep $mark.7 &" >"$folder/out" 2>"$folder/err" || code=$?
    ((code == 4)) || fail "$way: it ended with $code, not 4"
    (($(processes) == 0)) || fail "$way: $(processes) processes outlive the run"
    code=0
    "$way" "$emulator" between -- "$emulator" probe b:7002 --count 3 --rate 20 --- \
        sh -c "setsid $emulator probe --answer '[::]:7002' >/dev/null 2>&1 & exit 0" \
        >"$folder/out" 2>"$folder/err" || code=$?
    ((code == 0)) || fail "$way: a server in the background does not serve"
}

ways=(plain)
for way in no_pid_namespace hidden_proc; do
    code=0
    "$way" "$emulator" between -- true --- true >"$folder/out" 2>"$folder/err" || code=$?
    if ((code == 0)); then
        ways+=("$way")
    else
        echo "not tested: $way: $(tail -n 1 "$folder/err")"
    fi
done
for way in "${ways[@]}"; do survives_nothing "$way"; done

# inside SCRIPT: prints the output of a script that runs as command A.
inside() { "$emulator" between -- bash -c "$1" --- sleep "$mark.8" 2>"$folder/err"; }
[[ $(inside 'id -u; id -g') == "$(id -u; id -g)" ]] || fail 'the user is another one'
# shellcheck disable=SC2016 # the command expands it
{
    # With a PID namespace, the processes of the command are the only ones, and none is a zombie.
    seen=$(inside '(sleep 0.01 & ) ; sleep 0.2; ps -e -o pid=,stat=,comm=')
    if [[ $seen == *hapnet-init* && $seen != *' sleep'* ]]; then
        (($(wc -l <<<"$seen") <= 3)) || fail "the command sees others: $seen"
        [[ $seen != *' Z'* ]] || fail "a zombie is left: $seen"
        [[ $(inside 'echo $(($(readlink /proc/self) > 0)) $(pidof -s bash)') == "1 "[0-9]* ]] ||
            fail '/proc is not that of the command'
    else
        echo "not tested: /proc of a PID namespace, which is refused here"
    fi
    inside 'kill -TERM 1; kill -KILL 1; echo on' >"$folder/out" || true
    grep -q on "$folder/out" || fail 'a command can kill its init'
}

# At a terminal, keys reach the command, and its shells give the terminal back.
# types KEYS...: sends keys to a program at a terminal, one per second. A starts after 1 s.
types() {
    local keys
    for keys in "$@"; do
        sleep 1
        # shellcheck disable=SC2059 # escapes
        printf "$keys"
    done
}
code=0
types '' '' '\003' '' | script -qec "$emulator between -- bash -c 'trap \"exit 9\" INT; echo on
    while :; do sleep 0.05; done' --- sleep $mark.9" /dev/null >"$folder/out" 2>&1 || code=$?
((code == 9)) || fail "Ctrl-C ended it with $code, not 9"

cat >"$folder/shells" <<EOF
$emulator between -- bash --norc -ic 'echo in \$((40 + 2))' --- sleep $mark.9 2>/dev/null
read -r word </dev/tty
echo "after: \$word"
EOF
types '' '' 'typed\n' '' | script -qec "bash $folder/shells" /dev/null >"$folder/out" 2>&1 ||
    fail 'a shell at a terminal fails'
grep -q 'in 42' "$folder/out" || fail 'a shell at a terminal does not run'
grep -q 'after: typed' "$folder/out" || fail 'the terminal is not given back'

# Ctrl-Z stops the command, and fg continues it.
both="sh -c 'echo begun; sleep 3; echo done' --- sleep $mark.9"
types "$emulator between -- $both 2>/dev/null\n" \
    '' '\032' 'echo st"op"ped\n' 'fg\n' '' '' '' 'exit\n' |
    script -qec 'bash --norc -i' /dev/null >"$folder/out" 2>&1 || true
tr -d '\r' <"$folder/out" >"$folder/lines"
grep -q 'stopped$' "$folder/lines" || fail 'Ctrl-Z does not stop it'
grep -q 'done$' "$folder/lines" || fail 'it does not go on after Ctrl-Z'
await_processes 0 'at the end'
echo "passed (${ways[*]})"
