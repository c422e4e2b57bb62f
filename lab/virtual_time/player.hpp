// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/rig.hpp"
#include "lab/virtual_time/setting.hpp"
#include "lab/virtual_time/trace.hpp"
#include "peer/core/side.hpp"
#include "peer/line/line.hpp"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace hapnet::lab::virtual_time {

/// Which side of a session a player is, and in which run of its program.
struct PlayerId {
    std::size_t side = 0; // 0: L, with id 1; 1: R, with id 2
    std::uint32_t nonce = 1;
};

/// Where a side is on the network.
[[nodiscard]] secure::Place place_of(std::size_t side);

/// One side of a session in virtual time: everything that a peer daemon has but socket, clock,
/// thread and journal.
class VirtualPlayer {
public:
    VirtualPlayer(const Setting& setting, const PlayerId& id);

    /// A datagram that reached this machine from there at `arrived`, in the world's time.
    void receive(std::span<const std::byte> datagram, const secure::Place& from,
                 base::TimePoint arrived)
    {
        const base::TimePoint at = arrived + clock_ahead;
        if (const auto message = line.open(datagram, from, at)) side->on_datagram(*message, at);
    }
    /// The same from the other side.
    void receive(std::span<const std::byte> datagram, base::TimePoint arrived)
    {
        receive(datagram, other_place, arrived);
    }

    /// One tick of its loop, except for sending.
    void step(base::TimePoint now);
    /// What it sends in that tick: calls send(bytes, place) for each datagram.
    template <typename Send>
    void send_all(Send send)
    {
        line.send_all([this] { return side->poll(); }, send, stepped_at + clock_ahead);
    }

    [[nodiscard]] peer::Peer& peer() { return side->peer(); }
    [[nodiscard]] const peer::Peer& peer() const { return side->peer(); }
    [[nodiscard]] const peer::Tick& last() const { return side->tick(); }
    [[nodiscard]] base::Force told() const { return side->told(); }
    /// Its last tick, for the metrics.
    [[nodiscard]] Sample sample() const;

    // Open to tests and benches, which change them.
    device::Rig rig;
    std::unique_ptr<peer::Side> side;
    peer::line::Line line;
    secure::Place other_place;
    base::Duration clock_ahead{}; // of the world's time
    base::Duration date_ahead{};  // of its wall clock, besides

    base::TimePoint stepped_at;      // its last tick, in the world's time
    std::vector<peer::Event> events; // all so far
};

} // namespace hapnet::lab::virtual_time
