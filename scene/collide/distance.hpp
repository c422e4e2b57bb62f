// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/manifold.hpp"

#include <optional>

namespace hapnet::scene {

/// The distance between two shapes. < 0: they overlap, and it is minus the shortest way out.
struct Separation {
    double distance = 0.0;
    glm::dvec3 direction{0.0}; // unit, from the second to the first: the way out of an overlap
    glm::dvec3 on_first{0.0};  // nearest points of the two surfaces
    glm::dvec3 on_second{0.0};
};

/// Returns the exact separation of a point and a box or a round body. At the centre of a cube all
/// faces are equally near, and the first face counts.
[[nodiscard]] Separation separation(const glm::dvec3& point, const OrientedBox& box);

/// Returns the exact separation of two boxes or round bodies. For boxes that are apart it follows
/// from their corners and edges. For boxes that overlap it follows from their fifteen axes, and
/// `on_first` is the middle of the part of the first box that is deepest in the second.
[[nodiscard]] Separation separation(const OrientedBox& first, const OrientedBox& second);

/// The place where a ray enters a box or a round body. The distance is measured along `direction`
/// (of length 1) and is at most `length`. A ray from inside enters at once.
struct RayEntry {
    double distance = 0.0;
    glm::dvec3 normal{0.0}; // normal of the surface; against the ray if it began inside
};
[[nodiscard]] std::optional<RayEntry> enter(const OrientedBox& box, const glm::dvec3& origin,
                                            const glm::dvec3& direction, double length);

} // namespace hapnet::scene
