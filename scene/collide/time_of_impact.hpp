// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/manifold.hpp"

#include <optional>

namespace hapnet::scene {

/// When and on which axis two boxes that keep their orientation first touch.
struct TimeOfImpact {
    double time = 0.0;      // seconds from now
    glm::dvec3 normal{0.0}; // unit, from the first to the second
};

/// The first touch of `b` moving at `relative_velocity` seen from `a`, within [0, time_max];
/// nullopt when there is none, or when they overlap already. Exact for boxes that do not turn.
[[nodiscard]] std::optional<TimeOfImpact> time_of_impact(const OrientedBox& a, const OrientedBox& b,
                                                         const glm::dvec3& relative_velocity,
                                                         double time_max);

} // namespace hapnet::scene
