// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/maths/oscillator.hpp"
#include "scene/maths/vector.hpp"

#include <array>
#include <optional>

namespace hapnet::scene {

/// The courses of the three axes.
using Trajectories = std::array<Trajectory, 3>;

/// A quantity that is watched while the axes run their courses: level + slope t + the sum over the
/// axes of way_weight way + speed_weight speed. It is positive until what is waited for happens.
struct WatchedQuantity {
    double level = 0.0;
    double slope = 0.0;
    PerAxis displacement_weight{};
    PerAxis speed_weight{};
    bool leaves_zero = false; // it starts at 0 up to rounding, and is known to grow
};

/// Whether value + rate t cannot fall below 0 within `time` while |second derivative| <=
/// `second_derivative`.
[[nodiscard]] inline bool stays_positive(double value, double rate, double second_derivative,
                                         double time)
{
    return value + std::min(rate, 0.0) * time - 0.5 * second_derivative * time * time >= 0.0;
}

/// When the quantity first falls to 0, in [from, to); nullopt when it does not. No root is missed:
/// the search goes on by steps within which a bound of the second derivative rules one out, and
/// approaches the root from before it as fast as Newton's method does. After 200 steps, which take
/// a wave of some hundred periods, it only asks for the sign at the end.
[[nodiscard]] std::optional<double> first_root(const WatchedQuantity& watched,
                                               const Trajectories& trajectories, double from,
                                               double to);

} // namespace hapnet::scene
