// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace hapnet::base {

/// Finds the extents of reordered arrivals (RFC 4737, 4.2). The extent is the distance, in
/// arrivals, from the first arrival with a higher number to the reordered one. Remembers the last
/// in-order arrivals, in memory of a fixed size.
class ReorderExtents {
public:
    /// Number of in-order arrivals that are remembered.
    static constexpr std::size_t looks_back = 1024;

    /// Adds an arrival in order, as NextExpected classifies it.
    void in_order(std::uint64_t number)
    {
        records_[recorded_++ % looks_back] = {number, arrivals_++};
    }

    struct Extent {
        std::uint64_t arrivals = 0;
        /// True if the first arrival with a higher number may be older than all remembered
        /// arrivals. The extent then counts from the oldest remembered one, and may be too small.
        bool is_cut = false;
    };
    /// Adds a reordered arrival. At least one arrival in order must have come before it.
    Extent reordered(std::uint64_t number)
    {
        // The first arrival with a higher number was in order, as all arrivals before it had lower
        // numbers.
        const auto oldest = recorded_ > looks_back ? recorded_ - looks_back : 0;
        auto low = oldest;
        auto high = recorded_ - 1; // this record has a higher number
        while (low < high) {
            const auto middle = low + (high - low) / 2;
            if (records_[middle % looks_back].number > number) {
                high = middle;
            } else {
                low = middle + 1;
            }
        }
        return {arrivals_++ - records_[low % looks_back].place, low == oldest && oldest > 0};
    }

private:
    struct Record {
        std::uint64_t number = 0;
        std::uint64_t place = 0; // position among all arrivals
    };

    std::array<Record, looks_back> records_{}; // a ring, ascending in number and place
    std::uint64_t recorded_ = 0;
    std::uint64_t arrivals_ = 0;
};

} // namespace hapnet::base
