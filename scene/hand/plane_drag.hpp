// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/hand/advance.hpp"

#include <glm/geometric.hpp>

namespace hapnet::scene {

/// The motion of a body's centre over a time in which viscous drag along a plane and constant
/// forces act on it. It is exact however strong the drag is. Without drag it is the parabola.
class PlaneDrag {
public:
    PlaneDrag(const BodyDynamics& dynamics, double time);

    /// Returns the velocity at the end of the time.
    [[nodiscard]] glm::dvec3 velocity_after(const glm::dvec3& velocity,
                                            const glm::dvec3& acceleration) const
    {
        return scaled(velocity, &Factors::kept) + time_ * scaled(acceleration, &Factors::mean);
    }
    /// Returns the mean velocity over the time.
    [[nodiscard]] glm::dvec3 mean_velocity(const glm::dvec3& velocity,
                                           const glm::dvec3& acceleration) const
    {
        return scaled(velocity, &Factors::mean) + time_ * scaled(acceleration, &Factors::moved);
    }
    /// Returns the square root of the centre's response to a force: mean_velocity(0, M^-1 f) is
    /// time times this operator applied twice to f.
    [[nodiscard]] glm::dvec3 root_of_response(const glm::dvec3& force) const
    {
        return scaled(root_of_inverse_mass_ * force, &Factors::root_of_moved);
    }

private:
    /// The factors, with x = drag times time: exp(-x), (1 - exp(-x))/x and (x - 1 + exp(-x))/x^2.
    struct Factors { // the defaults are those without drag
        double kept = 1.0;
        double mean = 1.0;
        double moved = 0.5;
        double root_of_moved = root_of_half;
    };
    [[nodiscard]] static Factors factors_of(double x);
    [[nodiscard]] glm::dvec3 scaled(const glm::dvec3& v, double Factors::*factor) const
    {
        const double beside = along_.*factor;
        return beside * v + ((across_.*factor - beside) * glm::dot(across_axis_, v)) * across_axis_;
    }

    static constexpr double root_of_half = 0.70710678118654752440;

    double time_;
    glm::dvec3 root_of_inverse_mass_;
    glm::dvec3 across_axis_{0.0}; // unit: the plane's normal without its part along locked axes
    Factors along_;               // for all directions perpendicular to across_axis_
    Factors across_;
};

} // namespace hapnet::scene
