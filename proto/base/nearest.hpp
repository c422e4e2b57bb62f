// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>

namespace hapnet::base {

/// nearest() of a number that is known to be less than 2^63 in size.
[[nodiscard]] constexpr std::int64_t nearest_in_range(double x)
{
    const auto whole = static_cast<std::int64_t>(x);
    const double rest = x - static_cast<double>(whole); // exact
    return whole + static_cast<std::int64_t>(rest >= 0.5) - static_cast<std::int64_t>(rest <= -0.5);
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
