// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/virtual_time/player.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace hapnet::bench {

/// Cases take turns in blocks of this number of turns.
inline constexpr int turns_a_block = 1000;

/// The players of a session without an emulator: each gets in its next tick what the others sent in
/// this tick. The turns of the last player are timed.
class Circle {
public:
    using Bytes = std::vector<std::byte>;

    explicit Circle(const lab::virtual_time::Setting& setting);

    /// Plays a tick of all. Returns the time of the last player's turn, from opening received
    /// messages to sealing those that it sends, ns.
    double turn();
    [[nodiscard]] lab::virtual_time::VirtualPlayer& measured() { return players_.back(); }
    [[nodiscard]] base::TimePoint now() const { return now_; }
    /// The newest datagram from the first to the last.
    [[nodiscard]] const Bytes& newest() const { return newest_; }

private:
    struct Passing {
        std::size_t line; // the receiver's, to the sender
        Bytes bytes;
    };
    void play(std::size_t seat);

    std::deque<lab::virtual_time::VirtualPlayer> players_; // grows without moving its elements
    std::vector<std::vector<Passing>> inboxes_;
    Bytes newest_;
    base::TimePoint now_{std::chrono::seconds{1000}};
};

} // namespace hapnet::bench
