// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"

#include <cstdint>
#include <optional>

namespace hapnet::base {

/// Distinguishes arrivals in order from reordered arrivals (RFC 4737, 3.3). The next expected
/// number is one more than the highest that has arrived. An arrival with a lower number is
/// reordered.
class NextExpected {
public:
    /// `first` is the first number of the stream.
    constexpr explicit NextExpected(std::uint64_t first = 0) : next_{first} {}

    /// Adds an arrival. Returns the number of skipped numbers, which may still arrive, or nullopt
    /// if this arrival is reordered.
    constexpr std::optional<std::uint64_t> add(std::uint64_t number)
    {
        if (number < next_) [[unlikely]]
            return std::nullopt;
        const std::uint64_t skipped = number - next_;
        next_ = number + 1;
        return skipped;
    }

    [[nodiscard]] constexpr std::uint64_t next() const { return next_; }

private:
    std::uint64_t next_;
};

/// Counts of the arrivals of a numbered stream.
struct ArrivalCounts {
    std::uint64_t sent = 0;       // numbers up to the highest that has arrived
    std::uint64_t received = 0;   // distinct numbers that have arrived
    std::uint64_t duplicates = 0; // further copies, which no other count includes
    std::uint64_t reordered = 0;  // arrivals after one with a higher number (RFC 4737, 3.3)

    friend bool operator==(const ArrivalCounts&, const ArrivalCounts&) = default;
};
constexpr auto fields_of(Tag<ArrivalCounts>)
{
    using C = ArrivalCounts;
    return fields(
        "arrivals", member("sent", &C::sent, "The highest number that has come."),
        member("received", &C::received, "Different ones received."),
        member("duplicates", &C::duplicates, "Further copies of these."),
        member("reordered", &C::reordered, "Received after one with a higher number (RFC 4737)."));
}

/// Counts the arrivals of a numbered stream. The caller decides which arrivals are duplicates, with
/// RecentNumbers or otherwise.
class ArrivalCounter {
public:
    enum class Arrival : std::uint8_t { in_order, reordered, duplicate };

    /// `first` is the first number of the stream.
    explicit ArrivalCounter(std::uint64_t first) : expected_{first}, first_{first} {}

    Arrival add(std::uint64_t number, bool is_duplicate)
    {
        if (is_duplicate) {
            ++counts_.duplicates;
            return Arrival::duplicate;
        }
        ++counts_.received;
        if (!expected_.add(number)) {
            ++counts_.reordered;
            return Arrival::reordered;
        }
        counts_.sent = expected_.next() - first_;
        return Arrival::in_order;
    }

    [[nodiscard]] const ArrivalCounts& counts() const { return counts_; }

private:
    NextExpected expected_;
    std::uint64_t first_;
    ArrivalCounts counts_;
};

} // namespace hapnet::base
