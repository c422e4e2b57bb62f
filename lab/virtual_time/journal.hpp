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

/// The record that a daemon would make of a player in virtual time: a row for each of its ticks,
/// for each message that reaches it, and, once a second, for what it has agreed on with each of the
/// others.
class Journal {
public:
    using Sink = std::function<void(const record::Row& row)>;

    /// The player outlives it.
    Journal(const VirtualPlayer& player, Sink sink);

    /// The message of the player in that seat, before it is handed over.
    void on_message(std::size_t from_seat, const VirtualWorld::Arrival& arrival);
    /// Notes a tick. Call it after each tick of the player.
    void on_tick();

    /// The number of ticks so far.
    [[nodiscard]] std::uint64_t ticks() const { return tick_; }
    /// True if its bodies have rows of their own.
    [[nodiscard]] bool has_bodies() const { return has_bodies_; }

private:
    const VirtualPlayer& player_;
    Sink sink_;
    bool has_bodies_;
    std::uint64_t tick_ = 0;
    peer::SessionNotes notes_;
};

} // namespace hapnet::lab::virtual_time
