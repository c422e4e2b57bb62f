// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bounded.hpp"
#include "scene/rigid/free_flight.hpp"

#include <algorithm>
#include <vector>

namespace hapnet::scene {

/// Which awake bodies something acts on in a tick: a contact, a hand or a push. The others fly.
class ActiveBodies {
public:
    explicit ActiveBodies(Slot movable) : slots_{movable}, marks_(movable, 0) {}

    /// Whether the body was not one of them.
    bool add(Slot slot)
    {
        if (marks_[slot] != 0) return false;
        marks_[slot] = 1;
        slots_.add(slot);
        return true;
    }
    void clear()
    {
        for (const Slot slot : slots_) marks_[slot] = 0;
        slots_.clear();
    }

    /// In the order in which they came.
    [[nodiscard]] std::span<const Slot> slots() const { return slots_.all(); }

    /// Calls visit(range) for all the others up to `end`.
    template <typename Visit>
    void for_inactive(Slot end, Visit solve_block) const
    {
        const auto first = marks_.begin();
        const auto last = first + end;
        for (auto from = std::find(first, last, 0); from != last;) {
            const auto to = std::find(from, last, 1);
            solve_block(SlotRange{static_cast<Slot>(from - first), static_cast<Slot>(to - first)});
            from = std::find(to, last, 0);
        }
    }

private:
    Bounded<Slot> slots_;
    std::vector<std::uint8_t> marks_; // by slot
};

} // namespace hapnet::scene
