// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/manifold.hpp"

#include <array>
#include <cstdint>

namespace hapnet::scene {

/// The surface of a half-space. The normal points out of the solid.
struct PlaneSurface {
    glm::dvec3 normal{0.0, 1.0, 0.0};
    double offset = 0.0;
};

/// A corner of a box over a plane, or an end of a round body.
struct PlaneCorner {
    glm::dvec3 place{0.0};     // from the box's centre
    double rise = 0.0;         // height over the box's centre, along the plane's normal
    std::uint32_t feature = 0; // which corner: a bit for each axis on whose positive side it is
};

/// Returns the four deepest corners of a box over a plane with the given normal (out of the solid),
/// in a fixed order. These are the corners of the face that faces the plane most. When the box
/// stands on a corner, they are that corner and its three neighbours. The result does not depend on
/// the height of the box.
[[nodiscard]] std::array<PlaneCorner, manifold_points_max>
deepest_corners(const glm::dvec3& normal, const glm::dmat3& axes, const glm::dvec3& half);

/// Returns the lowest point of a sphere, or the lowest point of each end of a capsule. The other
/// entries are higher than any other point.
[[nodiscard]] std::array<PlaneCorner, manifold_points_max> lowest_points(const glm::dvec3& normal,
                                                                         const OrientedBox& round);

/// Finds the deepest corners of a box, or the lowest points of a round body, that are below a plane
/// or at most `margin` above it. The normal is the plane's: it points from the plane to the box.
[[nodiscard]] Manifold collide(const PlaneSurface& plane, const OrientedBox& box, double margin);

} // namespace hapnet::scene
