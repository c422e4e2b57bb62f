// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/columns.hpp"

#include <cstddef>

namespace hapnet::lab::metrics {

inline constexpr double tick_s = 0.001;

/// A side that rests and touches nothing.
[[nodiscard]] inline Columns resting(std::size_t count)
{
    Columns side;
    for (auto* column :
         {&side.body_x, &side.body_y, &side.hip_x, &side.hand_force, &side.push, &side.work}) {
        column->assign(count, 0.0);
    }
    side.touching.assign(count, 0);
    side.follows.assign(count, 0);
    return side;
}

/// A side that pushes all the time.
[[nodiscard]] inline Columns pushing(std::size_t count, double newtons)
{
    Columns side = resting(count);
    side.push.assign(count, newtons);
    side.touching.assign(count, 1);
    return side;
}

} // namespace hapnet::lab::metrics
