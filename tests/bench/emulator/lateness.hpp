// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <cstddef>
#include <vector>

namespace hapnet::bench {

[[nodiscard]] double microseconds(base::Duration duration);

/// Of sorted values, by nearest rank: one of them, in microseconds; NaN when there is none.
[[nodiscard]] double quantile_us(const std::vector<base::Duration>& sorted, double share);

/// When a datagram was due to leave, and how late it was.
struct Departure {
    base::TimePoint due{};
    base::Duration late{};
};

/// Times in which nothing left that was due, or only what had been due for long.
struct Stalls {
    std::size_t count = 0;
    base::Duration longest{};
};

/// A datagram that is later than `limit` has waited in a stall; those whose waits overlap have
/// waited in the same one.
[[nodiscard]] Stalls stalls_in(std::vector<Departure> departures, base::Duration limit);

} // namespace hapnet::bench
