// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/datagram.hpp"
#include "emulator/core/ring.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hapnet::emulator {

/// Holds datagrams until they are due. Of those due at the same time, those of push_sorted() leave
/// first, and then the others in the order in which they were pushed. Memory is taken once, at
/// construction.
class DelayLine {
public:
    explicit DelayLine(std::size_t datagrams_max);

    [[nodiscard]] bool is_full() const { return size() >= datagrams_max_; }

    /// Adds a datagram. Ensures that the line is not full.
    void push(const Datagram& datagram);

    /// Adds a datagram to those that leave in the order of their pushes. Each leaves at the
    /// earliest due time of these datagrams that is still unused when its turn comes. So both the
    /// set of times and the order are kept.
    void push_sorted(const Datagram& datagram);

    /// Takes the earliest datagram that is due at `now`.
    [[nodiscard]] std::optional<Datagram> pop(base::TimePoint now)
    {
        if (!are_in_turn()) return pop_earliest(now);
        if (in_turn_.empty() || in_turn_.front().due > now) return std::nullopt;
        return in_turn_.pop();
    }

    /// Returns the time when the earliest datagram is due; nullopt when the line is empty.
    [[nodiscard]] std::optional<base::TimePoint> next_due() const
    {
        if (!are_in_turn()) return earliest_due();
        if (in_turn_.empty()) return std::nullopt;
        return in_turn_.front().due;
    }

    [[nodiscard]] std::size_t size() const
    {
        return in_turn_.size() + heap_.size() + sorted_.size();
    }

private:
    struct HeapEntry {
        Datagram datagram;
        std::uint64_t rank = 0; // counts the pushes to the heap
    };
    static bool leaves_after(const HeapEntry& a, const HeapEntry& b);
    /// True if the datagrams are due in the order of arrival, as a constant delay leaves them.
    [[nodiscard]] bool are_in_turn() const { return heap_.empty() && times_.empty(); }
    [[nodiscard]] std::optional<base::TimePoint> earliest_due() const;
    [[nodiscard]] std::optional<Datagram> pop_earliest(base::TimePoint now);
    [[nodiscard]] Datagram pop_sorted();

    std::size_t datagrams_max_;
    std::uint64_t pushed_ = 0;
    Ring<Datagram> in_turn_;      // due in the order of arrival: a constant delay needs no heap
    std::vector<HeapEntry> heap_; // datagrams due before the last one in in_turn_ when pushed
    Ring<Datagram> sorted_;       // datagrams of push_sorted(), in their order
    std::vector<base::TimePoint> times_; // due times of push_sorted(), a heap
};

} // namespace hapnet::emulator
