// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/hands/motion_figures.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/random.hpp"

#include <cstddef>
#include <span>

namespace hapnet::lab::hands {

/// A motion as people make it: movements of minimum jerk from target to target (Flash, Hogan, J.
/// Neurosci. 5, 1985), rests between them, and unrest all the time. Targets are drawn from a normal
/// law, the times of movements from a lognormal one, and rests from an exponential one. The unrest
/// is a sum of four sines along each axis, within an octave of `unrest_hz`; its shares of the axes
/// are those of the targets.
struct MotionModel {
    double target_x_mm = 20.0;
    double target_y_mm = 20.0;
    double target_z_mm = 20.0;
    double movement_s = 0.8;
    double rest_s = 0.3;
    double unrest_mm_s = 20.0;
    double unrest_hz = 2.5;

    friend bool operator==(const MotionModel&, const MotionModel&) = default;
};
constexpr auto fields_of(base::Tag<MotionModel>)
{
    using M = MotionModel;
    return base::fields(
        "motion model",
        base::member("target_x_mm", &M::target_x_mm,
                     "Standard deviation along x of the targets between which the hand moves.")
            .rounded(3),
        base::member("target_y_mm", &M::target_y_mm, "Standard deviation along y of the targets.")
            .rounded(3),
        base::member("target_z_mm", &M::target_z_mm, "Standard deviation along z of the targets.")
            .rounded(3),
        base::member("movement_s", &M::movement_s, "Median time of a movement.").rounded(4),
        base::member("rest_s", &M::rest_s, "Mean rest between two movements.").rounded(4),
        base::member("unrest_mm_s", &M::unrest_mm_s, "Root mean square speed of the unrest.")
            .rounded(3),
        base::member("unrest_hz", &M::unrest_hz,
                     "Middle frequency of the unrest; it reaches from half of it to twice it.")
            .rounded(3));
}

/// Returns `count` places of such a motion, `rate_hz` a second. A pure function of its arguments.
[[nodiscard]] std::vector<glm::dvec3> simulated(const MotionModel& model, std::size_t count,
                                                double rate_hz, base::Seed seed);

/// Returns the model whose simulated motions have the figures of the recorded ones, in the mean:
/// the least sum of squared differences, relative to the standard deviation between the recorded
/// motions, but at least 0.1. The figures are compared as logarithms, the share of rest as twice
/// itself. Recorded motions of more than 30 s are cut into equal parts. The least sum is searched
/// from four fixed starts along one parameter after another, with steps that are halved (Hooke,
/// Jeeves, J. ACM 8, 1961). So it may be a local one. Needs at least one motion; each has at least
/// three places.
[[nodiscard]] MotionModel fitted_model(std::span<const Places> recorded);

} // namespace hapnet::lab::hands
