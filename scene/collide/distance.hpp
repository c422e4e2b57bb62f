// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/manifold.hpp"

#include <optional>

namespace hapnet::scene {

/// How far apart two things are; < 0 where they overlap: minus the shortest way out.
struct Separation {
    double distance = 0.0;
    glm::dvec3 direction{0.0}; // unit, from the second to the first: the way out
    glm::dvec3 on_first{0.0};  // the nearest points of their surfaces
    glm::dvec3 on_second{0.0};
};

/// Of a point and a box or a round body, exact. Where the centre of a cube has no nearest face, the
/// first counts.
[[nodiscard]] Separation separation(const glm::dvec3& point, const OrientedBox& box);

/// Of two, exact: of boxes by their corners and edges, or by their fifteen axes where they overlap.
/// There `on_first` is in the middle of what of the first is deepest in the second.
[[nodiscard]] Separation separation(const OrientedBox& first, const OrientedBox& second);

/// Where a ray enters a box or a round body: how far along `direction` (of length 1), at most
/// `length`. From inside it enters at once.
struct RayEntry {
    double distance = 0.0;
    glm::dvec3 normal{0.0}; // of the surface; against the ray where it began inside
};
[[nodiscard]] std::optional<RayEntry> enter(const OrientedBox& box, const glm::dvec3& origin,
                                            const glm::dvec3& direction, double length);

} // namespace hapnet::scene
