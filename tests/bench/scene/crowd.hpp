// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/scene/compare.hpp"

namespace hapnet::bench {

/// The cost of the paper's scene and of 1 to 10000 cubes: one pushed among sleepers, all awake, in
/// flight, landed.
[[nodiscard]] std::vector<Row> measure_costs(std::span<const Subject> subjects, bool is_quick);

/// Many cubes on a platform, the first one pushed to and fro between two hands.
[[nodiscard]] Course pushed_crowd(int count);

/// As many that fall and turn, each at its own rate, with nothing to fall on.
[[nodiscard]] Course flying_crowd(int count);

} // namespace hapnet::bench
