#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# One plan on many engines: one process, GNU parallel here and over ssh to this machine, an array of
# Slurm jobs on a cluster of one node. Shards are killed on the way. All have the same digest.
#   fleet_test.sh REPOSITORY BIN_DIR WORK_DIR [SEEDS [ENGINE...]]
# ENGINE is local, remote or array (default: all). A seed is 200 sessions: 50 are ten thousand.
# As root: Slurm's daemons and sshd run in WORK_DIR, on ports of their own, and end with it.
set -euo pipefail
repository=$1
bin=$(realpath "$2")
seeds=${4:-4}
rm -rf "$3"
mkdir -p "$3"
work=$(realpath "$3")
export HAPNET_BIN=$bin
lab=$bin/hapnet-lab
engines=("${@:5}")
((${#engines[@]} > 0)) || engines=(local remote array)
shards=8

fail() {
    echo "fleet_test: $1" >&2
    exit 1
}
left_out() { echo "fleet_test: left out: $1"; }
# have PROGRAM...: true if all of them are installed.
have() {
    local program
    for program in "$@"; do command -v "$program" >/dev/null || return 1; done
}

# wanted ENGINE
wanted() {
    local engine
    for engine in "${engines[@]}"; do [[ $engine != "$1" ]] || return 0; done
    return 1
}

daemons=()
cleanup() {
    for pid_file in "${daemons[@]}"; do
        [[ ! -s $pid_file ]] || kill "$(cat "$pid_file")" 2>/dev/null || true
    done
}
trap cleanup EXIT

cat >"$work/sweep.toml" <<'EOF'
kind = "plane"
title = "fleet"
duration = "8s"
algorithms = ["base", "dead-reckoning"]
tasks = ["T1", "T3"]
[plane]
delay = ["0ms", "40ms", "80ms", "120ms", "160ms"]
jitter = ["0ms", "5ms"]
loss = ["0%", "25%", "50%", "75%", "93%"]
EOF

digest_in() { sed -n 's/^digest //p' "$1"; }
# plan NAME: makes the same sweep in a folder of its own.
plan() { "$lab" plan "$work/sweep.toml" --seeds "$seeds" --out "$work/$1" >"$work/$1.plan.log"; }
# same NAME SINCE: expects the digest of the single process.
same() {
    local digest
    digest=$(digest_in "$work/$1.log")
    [[ $digest == "$whole" ]] || fail "$1: digest $digest, one process has $whole"
    (cd "$work/$1" && b2sum --quiet -c B2SUMS) || fail "$1: files and their sums differ"
    local code=0
    if ((seeds <= 4)); then # which takes some milliseconds a session
        PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 \
            "$repository/tests/e2e/schemas/schemas.py" "$bin" "$work/$1" || code=$?
        ((code == 0 || code == 77)) || fail "$1: JSON that is not as its schema says"
    fi
    echo "fleet_test: $1: the same digest, $((SECONDS - $2)) s"
}

begin=$SECONDS
"$lab" run "$work/sweep.toml" --seeds "$seeds" --out "$work/one" >"$work/one.log"
whole=$(digest_in "$work/one.log")
sessions=$(($(wc -l <"$work/one/sessions.csv") - 1))
echo "fleet_test: one process: $sessions sessions of 8 s in $((SECONDS - begin)) s: $whole"

# kill_some: kills programs that play a shard of a plan, twice.
kill_some() {
    local folder=$1 killed=0
    for _ in 1 2; do
        for _ in {1..600}; do
            local playing
            playing=$(pgrep -f -- "hapnet-lab run .*--shard [0-9]*/$shards" | head -1 || true)
            # Kills only programs of this folder, and only after they have played something.
            if [[ -n $playing ]] && tr '\0' ' ' <"/proc/$playing/cmdline" | grep -qF "$folder" &&
                [[ -n $(find "$folder/shards" -name '*.jsonl' -size +4k 2>/dev/null) ]]; then
                kill -KILL "$playing" && killed=$((killed + 1)) && break
            fi
            sleep 0.1
        done
        sleep 1
    done
    echo "fleet_test: killed $killed shards of ${folder##*/}"
}

begin=$SECONDS
if ! wanted local; then
    :
elif have parallel; then
    plan local
    "$repository/scripts/ssh.sh" "$work/local" --shards "$shards" >"$work/local.log"
    same local "$begin"
else
    left_out "GNU parallel is missing (Debian: parallel)"
fi

begin=$SECONDS
if ! wanted remote; then
    :
elif [[ ! -x /usr/sbin/sshd ]] || ! have ssh-keygen rsync parallel; then
    left_out "ssh: openssh-server, rsync or parallel is missing"
elif ((EUID != 0)); then
    left_out "ssh: its daemon needs root"
else
    ssh=$work/ssh
    mkdir -p "$ssh" /run/sshd
    ssh-keygen -q -t ed25519 -N '' -f "$ssh/host"
    ssh-keygen -q -t ed25519 -N '' -f "$ssh/own"
    cp "$ssh/own.pub" "$ssh/authorized"
    cat >"$ssh/config" <<EOF
Port 26822
ListenAddress 127.0.0.1
HostKey $ssh/host
PidFile $ssh/pid
AuthorizedKeysFile $ssh/authorized
StrictModes no
PasswordAuthentication no
PermitRootLogin prohibit-password
UsePAM no
EOF
    daemons+=("$ssh/pid")
    /usr/sbin/sshd -f "$ssh/config" -E "$ssh/log"
    echo "ssh -p 26822 -i $ssh/own -o StrictHostKeyChecking=accept-new \
-o UserKnownHostsFile=$ssh/known $(id -un)@127.0.0.1" >"$work/hosts"
    plan remote
    "$repository/scripts/ssh.sh" "$work/remote" --shards "$shards" --hosts "$work/hosts" \
        >"$work/remote.log"
    same remote "$begin"
fi

begin=$SECONDS
if ! wanted array; then
    :
elif ! have slurmctld slurmd munged sbatch; then
    left_out "Slurm: slurm-wlm or munge is missing"
elif ((EUID != 0)); then
    left_out "Slurm: its daemons need root"
else
    slurm=$work/slurm.run
    node=$(hostname -s)
    mkdir -p "$slurm"/{spool,state,log,munge}
    chmod 711 "$slurm/munge"
    chmod go+x "$work"
    (umask 077 && head -c 1024 /dev/urandom >"$slurm/munge/key")
    munged --key-file="$slurm/munge/key" --socket="$slurm/munge/socket" \
        --pid-file="$slurm/munge/pid" --log-file="$slurm/log/munged.log" \
        --seed-file="$slurm/munge/seed" --force 2>"$slurm/log/munged.err"
    daemons+=("$slurm/munge/pid")
    cat >"$slurm/slurm.conf" <<EOF
ClusterName=one
SlurmctldHost=$node(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$slurm/munge/socket
CredType=cred/munge
SlurmctldPort=26817
SlurmdPort=26818
StateSaveLocation=$slurm/state
SlurmdSpoolDir=$slurm/spool
SlurmctldPidFile=$slurm/slurmctld.pid
SlurmdPidFile=$slurm/slurmd.pid
SlurmctldLogFile=$slurm/log/slurmctld.log
SlurmdLogFile=$slurm/log/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=batch_sched_delay=0,sched_min_interval=1000
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
JobCompType=jobcomp/none
MpiDefault=none
ReturnToService=2
NodeName=$node NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=local Nodes=$node Default=YES MaxTime=INFINITE State=UP
EOF
    export SLURM_CONF=$slurm/slurm.conf
    daemons+=("$slurm/slurmd.pid" "$slurm/slurmctld.pid")
    slurmctld -c
    slurmd -c
    for _ in {1..150}; do
        [[ $(sinfo -h -o %T 2>/dev/null) != idle ]] || break
        sleep 0.2
    done
    [[ $(sinfo -h -o %T) == idle ]] || fail "the node of Slurm is not idle: $(sinfo -h -o '%T %E')"
    plan array
    begin=$SECONDS
    "$repository/scripts/slurm.sh" "$work/array" --shards "$shards"
    kill_some "$work/array"
    idle() { [[ -z $(squeue -h -o %i -n hapnet-shard,hapnet-merge) ]]; }
    wait_idle() {
        for _ in {1..36000}; do
            ! idle || return 0
            sleep 0.2
        done
        fail "Slurm does not end: $(squeue -h)"
    }
    wait_idle
    [[ ! -s $work/array/slurm/merge.log ]] || fail "merged without all shards"
    "$repository/scripts/slurm.sh" "$work/array" --shards "$shards" # what died
    wait_idle
    cp "$work/array/slurm/merge.log" "$work/array.log"
    same array "$begin"
fi
"$lab" compare "$work/one" "$work/one" >"$work/compare.log" ||
    fail "compare: $(cat "$work/compare.log")"
