# shellcheck shell=bash
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Three network namespaces in a row, joined by veth, for the sessions of scripts/lib/session.sh,
# which is to be sourced before: peer 1 - emulator - peer 2. To the programs it is a network with
# three hosts. Needs root.

namespaces=()

# use_namespaces: makes the namespaces, and plays all further sessions in them. Says why it cannot.
use_namespaces() {
    if ((EUID != 0)); then
        echo "${program:?}: network namespaces need root" >&2
        return 1
    elif ! command -v ip >/dev/null; then
        echo "$program: network namespaces need the command ip, of the package iproute2" >&2
        return 1
    fi
    trap 'stop_children; remove_namespaces' EXIT
    namespace=hapnet-$$
    make_namespaces && return
    remove_namespaces
    return 1
}

make_namespaces() {
    local name
    for name in "$namespace"-{1,emulator,2}; do
        ip netns add "$name" || return 1
        namespaces+=("$name")
    done
    join_to_emulator 1 10.77.1 && join_to_emulator 2 10.77.2
}

# join_to_emulator PEER PREFIX: two devices, PREFIX.1 at the peer and PREFIX.2 at the emulator.
join_to_emulator() {
    local peer=$namespace-$1 emulator=$namespace-emulator
    ip -n "$peer" link add emulator type veth peer name "peer-$1" netns "$emulator" &&
        ip -n "$peer" address add "$2.1/24" dev emulator &&
        ip -n "$emulator" address add "$2.2/24" dev "peer-$1" &&
        ip -n "$peer" link set emulator up &&
        ip -n "$emulator" link set "peer-$1" up
}

remove_namespaces() {
    local name
    for name in "${namespaces[@]}"; do ip netns del "$name" || true; done
    namespaces=()
    namespace=
}
