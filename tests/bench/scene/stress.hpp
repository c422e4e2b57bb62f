// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/scene/compare.hpp"

namespace hapnet::bench {

/// How far each engine can be driven: stiff springs, heavy on light, long ticks, fast bodies, and
/// for Hapnet inputs that make no sense (ODE aborts on those, so no peer gets them).
[[nodiscard]] std::vector<Row> measure_limits(std::span<const Subject> subjects, bool is_quick);

/// How many cubes of 10 mm come through a wall, of 64 in different orientations and four walls, at
/// speeds up to 1000 m/s. Every second one spins.
[[nodiscard]] std::vector<Row> turned_cubes(std::span<const Subject> subjects);

/// The largest of the trials, in their order, up to which every one holds; 0 when the first fails.
[[nodiscard]] double last_held(std::span<const double> trials,
                               const std::function<bool(double)>& holds);

} // namespace hapnet::bench
