// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/records/session.hpp"

#include <vector>

namespace hapnet::lab::records {

/// A value at a time since the session's start, on A's clock.
struct TimedValue {
    double time_s = 0.0;
    double value = 0.0;
};

/// How a session went over time: every tick in which a peer took part, hands off included.
struct SessionCurves {
    std::vector<TimedValue> cube_a_mm; // x of each copy of the cube
    std::vector<TimedValue> cube_b_mm;
    std::vector<TimedValue> apart_mm;  // |x_A - x_B| at equal times
    std::vector<TimedValue> force_a_n; // the force that each device was told
    std::vector<TimedValue> force_b_n;
};

[[nodiscard]] SessionCurves curves_of(const Session& session);

} // namespace hapnet::lab::records
