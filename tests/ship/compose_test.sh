#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# The services of packaging/docker/compose.yaml play a session: a container each, with the command,
# limits and volumes of the file, in one network namespace that has all addresses. The images are
# there already. Says why where it cannot be done, and exits 77.
#   compose_test.sh REPOSITORY IMAGES WORK_DIR
# IMAGES: the folder in which images_test.sh keeps what buildah stores.
set -euo pipefail
repository=$(realpath "$1")
images=$(realpath "$2")
mkdir -p "$3"
work=$(realpath "$3")

fail() {
    echo "compose_test: $1" >&2
    exit 1
}
skip() {
    echo "skipped: $1" && exit 77
}
if [[ ${4-} != inside ]]; then
    ((EUID == 0)) || skip "the services need a network namespace of their own, and root to make it"
    command -v ip >/dev/null || skip "ip is not installed (Debian: iproute2)"
    /usr/bin/python3 -c 'import yaml' 2>/dev/null ||
        skip "the module yaml is missing (Debian: python3-yaml)"
    unshare --net true 2>/dev/null || skip "no network namespaces here"
    exec unshare --net "$0" "$repository" "$images" "$work" inside
fi

export STORAGE_DRIVER=vfs BUILDAH_ISOLATION=chroot
buildah() { command buildah --root "$images/storage" --runroot "$images/run" "$@"; }
rm -rf "$work"/{out,volumes}
mkdir -p "$work"/{out,volumes}
chmod 777 "$work/out"
ip link set lo up
/usr/bin/python3 "$repository/tests/ship/compose.py" "$repository/packaging/docker/compose.yaml" \
    >"$work/services" || fail "compose.yaml: see above"

# A container for each service. A volume is a folder with the owner of the image's folder at its
# place, as for a new volume.
are_limited=yes
declare -A container=() mounts=() programs=() commands=()
while IFS="|" read -r name image address volumes limits command <&3; do
    ip address add "$address/32" dev lo
    given=()
    for limit in $limits; do given+=(--ulimit "$limit"); done
    container[$name]=$(buildah from --pull=never "${given[@]}" "localhost/hapnet-$image")
    if ! buildah run "${container[$name]}" -- true 2>"$work/limits"; then
        grep -q RLIMIT "$work/limits" || fail "$name does not begin: $(cat "$work/limits")"
        are_limited=
        container[$name]=$(buildah from --pull=never "localhost/hapnet-$image")
    fi
    mounts[$name]="--volume $work/out:/out"
    for volume in $volumes; do
        folder=$work/volumes/${volume%%:*}
        if [[ ! -d $folder ]]; then
            mkdir "$folder"
            owner=$(buildah run "${container[$name]}" -- stat -c %u:%g "${volume#*:}")
            chown "$owner" "$folder"
            chmod 700 "$folder"
        fi
        mounts[$name]+=" --volume $folder:${volume#*:}"
    done
    programs[$name]=hapnet-$image
    commands[$name]=$command
done 3<"$work/services"

# service NAME WORD...: runs the image's program with these words, in its container.
service() {
    # shellcheck disable=SC2086 # one word each
    buildah run ${mounts[$1]} "${container[$1]}" -- "${programs[$1]}" "${@:2}"
}
# with_command NAME WORD...: runs the file's command with these words added.
with_command() {
    local words
    read -ra words <<<"${commands[$1]}"
    service "$1" "${words[@]}" "${@:2}" >"$work/$1.log" 2>&1
}

# As the file says: each makes its key in its own volume, and learns the other's public key.
declare -A told=() ids=([left]=1 [right]=2)
for peer in left right; do
    service "$peer" keygen --own --id "${ids[$peer]}" --out /keys/own.key >"$work/keygen.log" ||
        fail "no key of $peer"
    told[$peer]=$(grep -o -e '--id.*' "$work/keygen.log")
done
# shellcheck disable=SC2086 # words
{ service left key add /keys/own.key ${told[right]} &&
    service right key add /keys/own.key ${told[left]}; } >"$work/keys.log" ||
    fail "keys: $(cat "$work/keys.log")"
with_command emulator --control /out/emulator.sock --stats /out/emulator.json &
emulator=$!
for _ in {1..300}; do
    [[ ! -S $work/out/emulator.sock ]] || break
    kill -0 "$emulator" 2>/dev/null || fail "the emulator: $(tail -3 "$work/emulator.log")"
    sleep 0.1
done
declare -A playing=()
for peer in left right; do
    with_command "$peer" --duration 6s --stats "/out/$peer.json" &
    playing[$peer]=$!
done
for peer in left right; do
    wait "${playing[$peer]}" || fail "$peer ended with $?: $(tail -3 "$work/$peer.log")"
done
# shellcheck disable=SC2086 # one word each
buildah run ${mounts[emulator]} "${container[emulator]}" -- \
    hapnet-ctl /out/emulator.sock stop >"$work/stop.log" || fail "the emulator takes no stop"
wait "$emulator" || fail "the emulator ended with $?: $(tail -3 "$work/emulator.log")"

for peer in left right; do
    jq -e '.messages.states_received > 1000 and .secure.agreed and .session != null' \
        "$work/out/$peer.json" >/dev/null ||
        fail "$peer: $(jq -c '{messages, secure, session}' "$work/out/$peer.json")"
done
jq -e '[.up, .down] | all(.received > 1000 and ([.dropped[]] | add // 0) == 0)' \
    "$work/out/emulator.json" >/dev/null ||
    fail "the emulator: $(jq -c '[.up, .down] | map({received, dropped})' \
        "$work/out/emulator.json")"
[[ -n $are_limited ]] ||
    echo "compose_test: the limits are left out: root may not raise them here"
[[ -z $are_limited ]] ||
    jq -e '.real_time.fifo and .real_time.locked_memory' "$work/out/emulator.json" >/dev/null ||
    fail "the limits of the file do not do: $(jq -c .real_time "$work/out/emulator.json")"
echo "compose_test: left heard $(jq .messages.states_received "$work/out/left.json") states," \
    "right $(jq .messages.states_received "$work/out/right.json"); the emulator dropped none"
