// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/scene/compare.hpp"

namespace hapnet::bench {

/// Measures the cost of the paper's scene and of 1 to 10000 cubes: one cube pushed among sleeping
/// ones, and all awake, in flight, or landed.
[[nodiscard]] std::vector<Row> measure_costs(std::span<const Subject> subjects, bool is_quick);

/// Many cubes on a platform, the first one pushed to and fro between two hands.
[[nodiscard]] Course pushed_crowd(int count);

/// As many cubes that fall and rotate, each at its own rate, without any ground.
[[nodiscard]] Course flying_crowd(int count);

} // namespace hapnet::bench
