// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "web/core/hand_hold.hpp"
#include "web/daemon.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace hapnet::web {

/// Passes the places from the page that holds the hand on to the hand's peer, and makes the peer
/// release the hand when no page holds it any more.
class HandDesk {
public:
    /// The greatest number of unanswered places. A peer that has this many is sent no more until it
    /// answers.
    static constexpr std::size_t asked_max = 8;

    /// Handles a message of a page about the hand. Returns the reply to that page; empty if there
    /// is nothing new.
    [[nodiscard]] std::string on_message(std::uint64_t page, const HandMessage& message,
                                         Daemon& peer, base::TimePoint now);

    /// True if a page held the hand in the last tick. tick() returns true if this has changed.
    /// `peer` is null if no peer has a hand that pages move.
    [[nodiscard]] bool is_held() const { return is_held_; }
    [[nodiscard]] bool tick(Daemon* peer, base::TimePoint now);

private:
    void ask(Daemon& peer, const std::optional<HandPlace>& place);

    HandHold hold_;
    bool is_held_ = false;
    bool has_told_ = false; // the peer was sent a place, but no release since then
    /// Counts unanswered requests. Each request holds a copy, and a daemon that disappears takes
    /// its copies along.
    std::shared_ptr<char> asked_ = std::make_shared<char>();
};

} // namespace hapnet::web
