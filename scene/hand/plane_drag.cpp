// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/hand/plane_drag.hpp"

#include "proto/base/math.hpp"
#include "scene/maths/vector.hpp"

#include <cmath>

namespace hapnet::scene {

PlaneDrag::PlaneDrag(const BodyDynamics& dynamics, double time)
    : time_{time}, root_of_inverse_mass_{glm::sqrt(dynamics.inverse_mass)}
{
    if (dynamics.drag == 0.0) return;
    along_ = across_ = factors_of(dynamics.drag * time);
    // Nothing moves along locked axes, so only the other components of the plane's normal count.
    const glm::dvec3& light = dynamics.inverse_mass;
    const glm::dvec3& normal = dynamics.drag_normal;
    const glm::dvec3 unlocked{light.x > 0.0 ? normal.x : 0.0, light.y > 0.0 ? normal.y : 0.0,
                              light.z > 0.0 ? normal.z : 0.0};
    const double square = glm::dot(unlocked, unlocked);
    if (!(square > 0.0)) return;
    across_axis_ = unlocked / std::sqrt(square);
    across_ = factors_of(std::max(1.0 - square, 0.0) * dynamics.drag * time);
}

PlaneDrag::Factors PlaneDrag::factors_of(double x)
{
    Factors factors;
    constexpr double small = 0.5; // the last term of the series is then below 1e-16
    if (x < small) {
        factors.moved = 0.0;
        for (double n = 14.0; n >= 2.0; n -= 1.0) factors.moved = (1.0 - x * factors.moved) / n;
        factors.mean = 1.0 - x * factors.moved;
        factors.kept = 1.0 - x * factors.mean;
    } else {
        factors.kept = base::exp(-x);
        factors.mean = (1.0 - factors.kept) / x;
        factors.moved = (1.0 - factors.mean) / x;
    }
    factors.root_of_moved = std::sqrt(factors.moved);
    return factors;
}

} // namespace hapnet::scene
