// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/records/path_stretches.hpp"
#include "lab/records/session.hpp"

#include <string>
#include <vector>

namespace hapnet::lab::records {

/// A value at a time since the session's start, on A's clock.
struct TimedValue {
    double time_s = 0.0;
    double value = 0.0;
};

/// The distance and the angle between the copies of one body over time.
struct BodyCurves {
    std::string name;
    std::vector<TimedValue> apart_mm;         // distance in three dimensions
    std::vector<TimedValue> turned_apart_deg; // empty: the body cannot turn
};

/// The curves of a session over time: every tick in which a peer took part, hands off included.
struct SessionCurves {
    std::vector<TimedValue> cube_a_mm; // x of the cube in each copy
    std::vector<TimedValue> cube_b_mm;
    std::vector<TimedValue> apart_mm;  // |x_A - x_B| of the first body at equal times
    std::vector<TimedValue> force_a_n; // size of the force sent to each device
    std::vector<TimedValue> force_b_n;
    std::vector<double> late_a_us; // lateness of each tick in the curves above
    std::vector<double> late_b_us;
    PathsOverTime paths;
    /// The curves of each body, where there are several bodies or one that can turn.
    std::vector<BodyCurves> bodies;
};

[[nodiscard]] SessionCurves curves_of(const Session& session);

} // namespace hapnet::lab::records
