// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/scene/compare.hpp"

namespace hapnet::bench {

/// Boxes that fall into a bin of 0.22 m by 0.22 m, each turned another way.
[[nodiscard]] Course bin(int count, double friction);

/// A wall of 48 bricks that a cube of 1 kg hits.
[[nodiscard]] Course brick_wall(double speed_m_per_s);

/// Twenty slabs on end in a line; the first one falls against the second.
[[nodiscard]] Course dominoes();

/// Cubes in ten rows; each row has one less than the row below it.
[[nodiscard]] Course pyramid();

/// A cube held by eight stiff hands: one on every face and two more. Each swings a little.
[[nodiscard]] Course stiff_hands();

/// Measures the worst effects of many bodies on each other: the deepest overlaps, and the cost of
/// the most expensive steps.
[[nodiscard]] std::vector<Row> measure_heaps(std::span<const Subject> subjects, bool is_quick);

} // namespace hapnet::bench
