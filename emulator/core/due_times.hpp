// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace hapnet::emulator {

/// The due time of each of many places, and the earliest due time, as a tournament tree. A place is
/// marked when its due time has to be read again, so that the cost of a round depends on the number
/// of changes instead of the number of places.
class DueTimes {
public:
    /// A place, identified by its number.
    class Place {
    public:
        Place() = default; // a place of no path; marking it has no effect
        Place(DueTimes& all, std::size_t number) : all_{&all}, number_{number} {}

        /// Marks this place, because its due time may have changed.
        void mark() const
        {
            if (all_ != nullptr) all_->mark(number_);
        }
        [[nodiscard]] std::size_t number() const { return number_; }

    private:
        DueTimes* all_ = nullptr;
        std::size_t number_ = 0;
    };

    /// Returns a new place. Its number is the lowest free one, from 0.
    Place add()
    {
        const auto free = std::ranges::find(is_taken_, false);
        const auto number = static_cast<std::size_t>(free - is_taken_.begin());
        if (free == is_taken_.end()) grow();
        is_taken_[number] = true;
        mark(number);
        return {*this, number};
    }

    void remove(std::size_t number)
    {
        is_taken_[number] = false;
        set(number, never);
    }

    /// Updates the due times of the places that were marked since the last call. `due_of(number)`
    /// returns the time when something is due there, if ever.
    void refresh(const auto& due_of)
    {
        for (const std::size_t number : marked_) {
            is_marked_[number] = 0;
            if (is_taken_[number]) set(number, due_of(number).value_or(never));
        }
        marked_.clear();
    }

    /// Returns the earliest due time. Call it after refresh().
    [[nodiscard]] std::optional<base::TimePoint> earliest() const
    {
        return tree_[1] == never ? std::nullopt : std::optional{tree_[1]};
    }

    /// Calls `visit(number)` for each place where something is due at `now`, in the order of their
    /// numbers. Call it after refresh(). `visit` may mark places.
    void each_due(base::TimePoint now, const auto& visit) const
    {
        if (is_due(1, now)) each_due_below(1, now, visit);
    }

private:
    static constexpr base::TimePoint never = base::TimePoint::max();

    void mark(std::size_t number)
    {
        if (is_marked_[number] != 0) return;
        is_marked_[number] = 1;
        marked_.push_back(number);
    }

    [[nodiscard]] std::size_t leaves() const { return tree_.size() / 2; }

    void grow()
    {
        is_taken_.push_back(false);
        is_marked_.push_back(0);
        marked_.reserve(is_taken_.size()); // nothing is allocated while datagrams pass
        const std::size_t wanted = std::bit_ceil(is_taken_.size());
        if (wanted == leaves()) return;
        std::vector<base::TimePoint> former(wanted, never);
        std::copy_n(tree_.begin() + static_cast<std::ptrdiff_t>(leaves()),
                    std::min(leaves(), wanted), former.begin());
        tree_.assign(2 * wanted, never);
        for (std::size_t i = 0; i < wanted; ++i) set(i, former[i]);
    }

    /// Sets a due time and updates the nodes above it: each node has the earlier one of the two
    /// below it, 2 n and 2 n + 1.
    void set(std::size_t number, base::TimePoint due)
    {
        std::size_t node = leaves() + number;
        tree_[node] = due;
        for (node /= 2; node >= 1; node /= 2) {
            const auto earlier = std::min(tree_[2 * node], tree_[2 * node + 1]);
            if (tree_[node] == earlier) return;
            tree_[node] = earlier;
        }
    }

    [[nodiscard]] bool is_due(std::size_t node, base::TimePoint now) const
    {
        return tree_[node] <= now && tree_[node] != never;
    }

    /// Visits what is due below a node that has something due. It recurses only where both halves
    /// have something due; mostly only one leaf is due.
    void each_due_below(std::size_t node, base::TimePoint now, const auto& visit) const
    {
        while (node < leaves()) {
            node *= 2;
            if (!is_due(node, now)) {
                ++node;
            } else if (is_due(node + 1, now)) {
                each_due_below(node, now, visit);
                ++node;
                if (!is_due(node, now)) return; // visit() has changed it
            }
        }
        visit(node - leaves());
    }

    std::vector<base::TimePoint> tree_{never, never}; // the root is [1], the leaves the last half
    std::vector<bool> is_taken_;
    // Bytes instead of bits, because each datagram reads and writes them
    std::vector<char> is_marked_;
    std::vector<std::size_t> marked_;
};

} // namespace hapnet::emulator
