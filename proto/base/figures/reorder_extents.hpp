// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace hapnet::base {

/// Finds the extents of reordered arrivals (RFC 4737, 4.2): how many arrivals after the first one
/// with a higher number they came. Remembers the last in-order arrivals, in memory of a fixed size.
class ReorderExtents {
public:
    /// Number of in-order arrivals that are remembered.
    static constexpr std::size_t looks_back = 1024;

    /// Takes an arrival in order, as NextExpected tells it.
    void in_order(std::uint64_t number)
    {
        records_[recorded_++ % looks_back] = {number, arrivals_++};
    }

    struct Extent {
        std::uint64_t arrivals = 0;
        /// True if the first arrival with a higher number may lie further back than is remembered:
        /// the extent counts from the oldest that is, and may be too small.
        bool is_cut = false;
    };
    /// Takes a reordered arrival: at least one in order came before it.
    Extent reordered(std::uint64_t number)
    {
        // The first arrival with a higher number was in order: all before it had lower numbers.
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
