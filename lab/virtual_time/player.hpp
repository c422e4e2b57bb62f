// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/rig.hpp"
#include "lab/virtual_time/setting.hpp"
#include "lab/virtual_time/trace.hpp"
#include "peer/core/side.hpp"
#include "peer/line/line.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace hapnet::lab::virtual_time {

/// The seat of a player in a session, and the number of the run of its program.
struct PlayerId {
    std::size_t seat = 0; // the player's id is seat + 1
    std::uint32_t nonce = 1;
};

/// Returns the place of a player on the network.
[[nodiscard]] inline secure::Place place_of(std::size_t seat)
{
    secure::Place place{};
    place.front() = static_cast<std::byte>(seat + 1);
    return place;
}

/// Makes the device of a player, behind its governor.
[[nodiscard]] device::Rig make_rig(const Setting& setting, const PlayerId& id);

/// One player of a session in virtual time: a peer daemon without socket, clock, thread and
/// journal.
class VirtualPlayer {
public:
    VirtualPlayer(const Setting& setting, const PlayerId& id);

    /// Receives a datagram that reached this machine at `arrived`, in the world's time, from
    /// `place`, on the line to one of the other players.
    void receive(std::size_t other, const secure::Place& place, std::span<const std::byte> datagram,
                 base::TimePoint arrived)
    {
        const base::TimePoint at = arrived + clock_ahead;
        if (const auto message = lines[other].open(datagram, place, at))
            side->on_datagram(*message, at, other);
    }
    /// Receives a datagram from the usual place of that player.
    void receive(std::size_t other, std::span<const std::byte> datagram, base::TimePoint arrived)
    {
        receive(other, place_of(other < own_seat ? other : other + 1), datagram, arrived);
    }

    /// Plays one tick of the loop, except for sending.
    void step(base::TimePoint now);
    /// Sends the messages of that tick. Calls send(other, bytes, place) for each datagram, where
    /// `other` is the number of the line.
    template <typename Send>
    void send_all(Send send)
    {
        for (std::size_t other = 0; other < lines.size(); ++other) {
            lines[other].send_all([this, other] { return side->poll(other); },
                                  [&send, other](std::span<const std::byte> bytes,
                                                 const auto& place) { send(other, bytes, place); },
                                  stepped_at + clock_ahead);
        }
    }

    [[nodiscard]] peer::Peer& peer() { return side->peer(); }
    [[nodiscard]] const peer::Peer& peer() const { return side->peer(); }
    [[nodiscard]] const peer::Tick& last() const { return side->tick(); }
    [[nodiscard]] base::Force told() const { return side->told(); }
    /// Returns the state of its last tick, for the metrics.
    [[nodiscard]] Sample sample() const;
    /// Adds the poses after its last tick of all shared bodies but the first.
    void add_further_bodies(std::vector<Pose>& poses) const;

    // These members are public for tests and benches, which change them.
    device::Rig rig;
    std::unique_ptr<peer::Side> side;
    std::vector<peer::line::Line> lines; // one to each other player, in the order of their ids
    std::size_t own_seat = 0;
    base::Duration clock_ahead{}; // the player's clock minus the world's time
    base::Duration date_ahead{};  // its wall clock minus its own clock

    bool can_turn = false;           // true if the shared body can turn
    base::TimePoint stepped_at;      // time of its last tick, in the world's time
    std::size_t tended = 0;          // index of the line whose keys were renewed last
    std::vector<peer::Event> events; // all events so far
};

} // namespace hapnet::lab::virtual_time
