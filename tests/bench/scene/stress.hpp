// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/scene/compare.hpp"

namespace hapnet::bench {

/// Measures the limits of each engine: stiff springs, heavy bodies on light ones, long ticks, fast
/// bodies, and for Hapnet meaningless inputs, on which ODE aborts, so no peer gets them.
[[nodiscard]] std::vector<Row> measure_limits(std::span<const Subject> subjects, bool is_quick);

/// Counts cubes of 10 mm that pass a wall: 64 in different orientations and four walls, at speeds
/// up to 1000 m/s. Every second cube spins.
[[nodiscard]] std::vector<Row> turned_cubes(std::span<const Subject> subjects);

/// Returns the largest of the ascending trials up to which all hold; 0 when the first fails.
[[nodiscard]] double last_held(std::span<const double> trials,
                               const std::function<bool(double)>& holds);

} // namespace hapnet::bench
