// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <cstddef>
#include <vector>

namespace hapnet::bench {

[[nodiscard]] double microseconds(base::Duration duration);

/// Returns a quantile of sorted values by nearest rank, microseconds; NaN without values.
[[nodiscard]] double quantile_us(const std::vector<base::Duration>& sorted, double share);

/// The due time of a datagram, and its lateness.
struct Departure {
    base::TimePoint due{};
    base::Duration late{};
};

/// Times in which no datagram left that was due, or only datagrams long overdue.
struct Stalls {
    std::size_t count = 0;
    base::Duration longest{};
};

/// A datagram that is later than `limit` has waited in a stall; those whose waits overlap have
/// waited in the same one.
[[nodiscard]] Stalls stalls_in(std::vector<Departure> departures, base::Duration limit);

} // namespace hapnet::bench
