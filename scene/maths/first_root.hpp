// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/maths/oscillator.hpp"
#include "scene/maths/vector.hpp"

#include <array>
#include <cstdint>
#include <optional>

namespace hapnet::scene {

/// The trajectories of the three axes.
using Trajectories = std::array<Trajectory, 3>;

/// A quantity that is watched while the axes move along their trajectories: level + slope t + the
/// sum over the axes of displacement_weight displacement + speed_weight speed. It is positive until
/// the event.
struct WatchedQuantity {
    double level = 0.0;
    double slope = 0.0;
    PerAxis displacement_weight{};
    PerAxis speed_weight{};
    bool leaves_zero = false; // the quantity starts at 0 up to rounding, and is known to grow
};

/// True if value + rate t cannot fall below 0 within `time` while |second derivative| <=
/// `second_derivative`.
[[nodiscard]] inline bool stays_positive(double value, double rate, double second_derivative,
                                         double time)
{
    return value + std::min(rate, 0.0) * time - 0.5 * second_derivative * time * time >= 0.0;
}

/// The result of a search for a root.
struct RootSearch {
    enum class End : std::uint8_t { none, found, given_up };
    End end = End::none;
    double time = 0.0; // time of the root; if given up: there is none before it
};

/// Finds the time when the quantity first falls to 0, in [from, to). No root is missed: each step
/// is so short that a bound of the second derivative rules out a root within it. The search
/// approaches the root from before it as fast as Newton's method does. It is given up after 200
/// steps, which suffice for some hundred periods of a wave, or when `steps_left` is used up.
[[nodiscard]] RootSearch search_root(const WatchedQuantity& watched,
                                     const Trajectories& trajectories, double from, double to,
                                     int& steps_left);

/// Returns the time that search_root() finds; nullopt when the quantity does not fall to 0. After
/// 200 steps it only checks the sign at the end.
[[nodiscard]] std::optional<double> first_root(const WatchedQuantity& watched,
                                               const Trajectories& trajectories, double from,
                                               double to);

} // namespace hapnet::scene
