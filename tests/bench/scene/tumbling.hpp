// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/scene/compare.hpp"

namespace hapnet::bench {

/// A box of 60 x 40 x 20 mm that falls by 0.2 m onto a floor, spinning.
[[nodiscard]] Course tumbling_box(double friction);

/// That box spinning on its corner, at 300 rad/s.
[[nodiscard]] Course top();

/// A box that tips over a ledge, falls, and lands.
[[nodiscard]] Course ledge();

/// The energy that a body gains in a course, summed over the ticks in which it gains some, J.
/// Nothing drives the body, so it should gain none.
[[nodiscard]] double energy_gain(Engine& engine, const Course& course, double tick_s);

/// Measures energy gained without work, of bodies that tumble, spin and tip.
[[nodiscard]] std::vector<Row> measure_tumbling(std::span<const Subject> subjects);

} // namespace hapnet::bench
