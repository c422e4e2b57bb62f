// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>

namespace hapnet::base {

/// Does the work of nearest() for a number with |x| < 2^63.
[[nodiscard]] constexpr std::int64_t nearest_in_range(double x)
{
    // Just below one half. The sum reaches the next whole number only if the fraction of `x` is at
    // least one half. One half itself would also round up the largest double below 0.5.
    constexpr double almost_half = 0x1.fffffffffffffp-2;
    return static_cast<std::int64_t>(x + __builtin_copysign(almost_half, x));
}

/// Returns the whole number nearest to `x`, with halves away from zero, like std::llround. It is
/// inline, because each tick rounds often and llround is a call. Returns the smallest std::int64_t
/// if |x| >= 2^63 or x is NaN.
[[nodiscard]] constexpr std::int64_t nearest(double x)
{
    constexpr double limit = 0x1p63;
    if (!(x > -limit && x < limit)) return std::numeric_limits<std::int64_t>::min();
    return nearest_in_range(x);
}

} // namespace hapnet::base
