// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>

namespace hapnet::lab::metrics {

/// Returns the number of ticks nearest to `seconds`, which is not negative and no longer than a
/// session.
[[nodiscard]] inline std::size_t ticks_in(double seconds, double tick_s)
{
    return static_cast<std::size_t>(std::lround(seconds / tick_s));
}

} // namespace hapnet::lab::metrics
