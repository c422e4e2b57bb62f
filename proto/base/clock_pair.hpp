// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <chrono>

namespace hapnet::base {

/// Largest difference between stamps of one clock, apart from the travel time of a message: stamps
/// are converted from the wall clock, and taken a little late.
inline constexpr Duration stamps_differ_by{std::chrono::milliseconds{1}};

/// True if an offset, known to `uncertainty`, shows that two clocks differ although both sides
/// report the same boot. This happens with two time namespaces, or with two virtual machines from
/// one snapshot.
[[nodiscard]] constexpr bool are_two_clocks(Duration offset, Duration uncertainty)
{
    const Duration most = uncertainty + stamps_differ_by;
    return offset > most || offset < -most;
}

} // namespace hapnet::base
