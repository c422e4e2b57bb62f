// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/box_plane.hpp"
#include "scene/collide/manifold.hpp"

#include <optional>

namespace hapnet::scene {

/// The time and the axis at which two boxes that keep their orientation first touch.
struct TimeOfImpact {
    double time = 0.0;      // seconds from now
    glm::dvec3 normal{0.0}; // unit, from the first to the second
};

/// Returns the first touch of `a` and `b` within [0, time_max], where `b` moves at
/// `relative_velocity` as seen from `a`. Returns nullopt when there is none, or when they overlap
/// already. Exact for boxes that do not rotate.
[[nodiscard]] std::optional<TimeOfImpact> time_of_impact(const OrientedBox& a, const OrientedBox& b,
                                                         const glm::dvec3& relative_velocity,
                                                         double time_max);

/// The distance between two surfaces along the normal along which they are farthest apart; < 0:
/// overlap.
struct Gap {
    double distance = 0.0;
    glm::dvec3 normal{0.0, 1.0, 0.0}; // unit, from the first to the second
};
[[nodiscard]] Gap gap_between(const OrientedBox& a, const OrientedBox& b);
[[nodiscard]] Gap gap_between(const PlaneSurface& plane, const OrientedBox& box);

} // namespace hapnet::scene
