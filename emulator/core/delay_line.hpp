// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/ring.hpp"
#include "emulator/core/slab.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hapnet::emulator {

/// A datagram on its way through the emulator.
struct Datagram {
    Slab::Slot slot = Slab::no_slot; // no_slot: the bytes are the caller's own
    bool is_copy = false;
    std::uint64_t number = 0; // of the datagram in its direction, from 0; a copy has its original's
    base::TimePoint arrival{};
    base::TimePoint due{};              // never leaves before
    std::span<const std::byte> bytes{}; // stay where they are until it has left
};

/// Holds datagrams until they are due. Those due at the same time leave in the order in which they
/// were pushed. Memory is taken once, at construction.
class DelayLine {
public:
    explicit DelayLine(std::size_t datagrams_max);

    [[nodiscard]] bool is_full() const { return size() >= datagrams_max_; }

    /// Ensures that it is not full.
    void push(const Datagram& datagram);

    /// The datagram takes the earliest of the times that were pushed here, its own and those of
    /// others, which is still free when it is its turn: the times are kept and so is the order.
    void push_sorted(const Datagram& datagram);

    /// The earliest datagram that is due at `now`.
    [[nodiscard]] std::optional<Datagram> pop(base::TimePoint now);

    /// When the earliest datagram is due; nullopt when the line is empty.
    [[nodiscard]] std::optional<base::TimePoint> next_due() const;

    [[nodiscard]] std::size_t size() const
    {
        return in_turn_.size() + heap_.size() + sorted_.size();
    }

private:
    struct Entry {
        Datagram datagram;
        std::uint64_t rank = 0; // of its push
    };
    static bool leaves_after(const Entry& a, const Entry& b);
    [[nodiscard]] Datagram pop_sorted();

    std::size_t datagrams_max_;
    std::uint64_t pushed_ = 0;
    Ring<Entry> in_turn_;     // due in the order in which they came: a constant delay needs no heap
    std::vector<Entry> heap_; // the others
    Ring<Datagram> sorted_;   // these wait for ...
    std::vector<base::TimePoint> times_; // ... these, a heap
};

} // namespace hapnet::emulator
