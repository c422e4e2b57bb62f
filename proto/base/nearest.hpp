// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>

namespace hapnet::base {

/// nearest() of a number that is known to be less than 2^63 in size.
[[nodiscard]] constexpr std::int64_t nearest_in_range(double x)
{
    // Just below a half: what is a half off rounds to the next number in the sum, nothing else
    // does.
    constexpr double almost_half = 0x1.fffffffffffffp-2;
    return static_cast<std::int64_t>(x + __builtin_copysign(almost_half, x));
}

/// The whole number nearest to `x`, halves away from zero: what std::llround gives, in place. That
/// one is a call, and a tick rounds often. The least number there is where |x| >= 2^63 or no
/// number.
[[nodiscard]] constexpr std::int64_t nearest(double x)
{
    constexpr double limit = 0x1p63;
    if (!(x > -limit && x < limit)) return std::numeric_limits<std::int64_t>::min();
    return nearest_in_range(x);
}

} // namespace hapnet::base
