// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace hapnet::device {

/// Returns the progress of a minimum-jerk movement, 0 to 1, when the share u of its time has passed
/// (Flash and Hogan 1985). u outside 0 to 1 is clamped.
[[nodiscard]] constexpr double minimum_jerk(double u)
{
    const double t = std::clamp(u, 0.0, 1.0);
    return t * t * t * (10.0 + t * (6.0 * t - 15.0));
}

} // namespace hapnet::device
