// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/rig.hpp"
#include "lab/virtual_time/setting.hpp"
#include "lab/virtual_time/trace.hpp"
#include "peer/core/peer.hpp"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace hapnet::lab {

/// Which side of a session a player is, and in which run of its program.
struct Seat {
    std::size_t side = 0; // 0: L, with id 1; 1: R, with id 2
    std::uint32_t nonce = 1;
};

/// One side of a session: everything that a peer daemon has but socket, clock, thread and journal.
/// What its turn does is what peer::Servo does in one.
class VirtualPlayer {
public:
    VirtualPlayer(const Setting& setting, const Seat& seat);

    /// A datagram that reached this machine at `arrived`, in the world's time.
    void receive(std::span<const std::byte> datagram, base::TimePoint arrived)
    {
        peer->on_datagram(datagram, arrived + clock_ahead);
    }

    /// One turn of its loop, but for what it sends: poll `peer` for that.
    void turn(base::TimePoint now);

    /// What it did in its last turn.
    [[nodiscard]] Sample sample() const;

    // Open to whoever plays fate.
    device::Rig rig;
    std::unique_ptr<peer::Peer> peer;
    base::Duration clock_ahead{}; // of the world's time

    // Of its last turn.
    base::TimePoint turned; // when, in the world's time
    device::Sample hand;
    peer::Tick last;
    base::Force applied;

    std::vector<peer::Event> events;     // all so far
    std::optional<base::TimePoint> cued; // the start it was cued for
    std::uint16_t id;
};

} // namespace hapnet::lab
