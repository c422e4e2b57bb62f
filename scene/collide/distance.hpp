// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/manifold.hpp"

#include <optional>

namespace hapnet::scene {

/// The distance between two things; < 0 where they overlap: minus the shortest way out.
struct Separation {
    double distance = 0.0;
    glm::dvec3 direction{0.0}; // unit, from the second to the first: the way out
    glm::dvec3 on_first{0.0};  // nearest points of the two surfaces
    glm::dvec3 on_second{0.0};
};

/// Returns the exact separation of a point and a box or a round body. Where the centre of a cube
/// has no nearest face, the first face counts.
[[nodiscard]] Separation separation(const glm::dvec3& point, const OrientedBox& box);

/// Returns the exact separation of two boxes or round bodies. That of boxes follows from their
/// corners and edges. For boxes that overlap it follows from their fifteen axes; `on_first` is then
/// in the middle of the part of the first box that is deepest in the second.
[[nodiscard]] Separation separation(const OrientedBox& first, const OrientedBox& second);

/// The place where a ray enters a box or a round body: the distance along `direction` (of length
/// 1), at most `length`. A ray from inside enters at once.
struct RayEntry {
    double distance = 0.0;
    glm::dvec3 normal{0.0}; // normal of the surface; against the ray if it began inside
};
[[nodiscard]] std::optional<RayEntry> enter(const OrientedBox& box, const glm::dvec3& origin,
                                            const glm::dvec3& direction, double length);

} // namespace hapnet::scene
