// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/virtual_time/world.hpp"
#include "peer/core/session_notes.hpp"
#include "proto/record/rows.hpp"

#include <cstdint>
#include <functional>
#include <utility>

namespace hapnet::lab::virtual_time {

/// The record that a daemon would make of a player in virtual time. It has a row for each tick and
/// each message that reaches the player. Once a second it has a row for each of the other players,
/// with the state of their agreement.
class Journal {
public:
    using Sink = std::function<void(const record::Row& row)>;

    /// The player must outlive the journal.
    Journal(const VirtualPlayer& player, Sink sink);

    /// Notes a message from the player in that seat. Call it before the message is handed over.
    void on_message(std::size_t from_seat, const VirtualWorld::Arrival& arrival);
    /// Notes a tick. Call it after each tick of the player.
    void on_tick();

    /// Returns the number of ticks so far.
    [[nodiscard]] std::uint64_t ticks() const { return tick_; }
    /// True if the player's bodies have rows of their own.
    [[nodiscard]] bool has_bodies() const { return has_bodies_; }

private:
    const VirtualPlayer& player_;
    Sink sink_;
    bool has_bodies_;
    std::uint64_t tick_ = 0;
    peer::SessionNotes notes_;
};

} // namespace hapnet::lab::virtual_time
