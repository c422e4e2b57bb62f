// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <chrono>

namespace hapnet::base {

/// The largest difference between two stamps of one clock, apart from the travel time of the
/// message. Stamps are converted from the wall clock and are taken a little late, so they are not
/// exact.
inline constexpr Duration stamps_differ_by{std::chrono::milliseconds{1}};

/// True if an offset with this `uncertainty` shows that two clocks differ although both sides
/// report the same boot. This happens with two time namespaces, or with two virtual machines that
/// were started from one snapshot.
[[nodiscard]] constexpr bool are_two_clocks(Duration offset, Duration uncertainty)
{
    const Duration most = uncertainty + stamps_differ_by;
    return offset > most || offset < -most;
}

} // namespace hapnet::base
