// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/state.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::bench {

using Hips = std::array<scene::HandInput, scene::hands_max>;

/// The hands before anyone has said where they are.
[[nodiscard]] inline Hips absent_hips()
{
    Hips hands;
    for (scene::HandInput& hip : hands) hip.present = false;
    return hands;
}

/// A force and where it acts.
struct Load {
    glm::dvec3 force{0.0};
    glm::dvec3 point{0.0};
};

/// The hand's spring and damper on a box, from its state at one moment: what haptic libraries hold
/// for a step, and what the reference integrates. The sphere's centre may lie within the box.
[[nodiscard]] inline Load penalty(const scene::BodyState& body, const glm::dvec3& half,
                                  const scene::HandInput& hip, const scene::HandDescription& hands)
{
    if (!hip.present) return {};
    const glm::dvec3 local =
        glm::conjugate(body.orientation) * (hip.position.value - body.position.value);
    glm::dvec3 nearest = glm::clamp(local, -half, half);
    glm::dvec3 away = local - nearest; // from the surface to the sphere's centre
    const double distance = std::sqrt(glm::dot(away, away));
    double depth = hands.radius_m - distance;
    if (depth <= 0.0) return {};
    if (distance > 0.0) {
        away /= distance;
    } else {
        const glm::dvec3 gap = half - glm::abs(local);
        const int axis = gap.x <= gap.y && gap.x <= gap.z ? 0 : gap.y <= gap.z ? 1 : 2;
        away = glm::dvec3{0.0};
        away[axis] = local[axis] < 0.0 ? -1.0 : 1.0;
        nearest[axis] = away[axis] * half[axis];
        depth = hands.radius_m + gap[axis];
    }
    const glm::dvec3 normal = body.orientation * -away; // the way it pushes
    const glm::dvec3 arm = body.orientation * nearest;
    const glm::dvec3 velocity = body.velocity.value + glm::cross(body.angular_velocity, arm);
    const double approach = glm::dot(hip.velocity.value - velocity, normal);
    const double force =
        std::clamp(hands.stiffness_n_per_m * depth + hands.damping_ns_per_m * approach, 0.0,
                   hands.force_max_n);
    return {force * normal, body.position.value + arm};
}

} // namespace hapnet::bench
