// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <chrono>

namespace hapnet::base {

/// What stamps of one clock may differ by besides the way that a message takes: they are converted
/// from the wall clock, and taken a little late.
inline constexpr Duration stamps_differ_by{std::chrono::milliseconds{1}};

/// Whether an offset that is known to `uncertainty` shows that two clocks are not one, although
/// both sides name the same boot: they are in two time namespaces, or in two virtual machines that
/// were made of one snapshot.
[[nodiscard]] constexpr bool are_two_clocks(Duration offset, Duration uncertainty)
{
    const Duration most = uncertainty + stamps_differ_by;
    return offset > most || offset < -most;
}

} // namespace hapnet::base
