// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/collide/box_plane.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace hapnet::scene {

namespace {

using Triple = std::array<double, 3>;
using Corners = std::array<std::uint32_t, manifold_points_max>;

/// Returns the four deepest corners of a box whose half edges add `rise` to a corner's height.
Corners deepest(const Triple& rise)
{
    const Triple size{std::abs(rise[0]), std::abs(rise[1]), std::abs(rise[2])};
    const std::uint32_t lowest =
        (rise[0] < 0.0 ? 1U : 0U) | (rise[1] < 0.0 ? 2U : 0U) | (rise[2] < 0.0 ? 4U : 0U);
    if (size[2] >= size[0] + size[1]) {
        const std::uint32_t face = lowest & 4U;
        return {face, face | 1U, face | 2U, face | 3U};
    }
    if (size[1] >= size[0] + size[2]) {
        const std::uint32_t face = lowest & 2U;
        return {face, face | 1U, face | 4U, face | 5U};
    }
    if (size[0] >= size[1] + size[2]) {
        const std::uint32_t face = lowest & 1U;
        return {face, face | 2U, face | 4U, face | 6U};
    }
    return {lowest, lowest ^ 1U, lowest ^ 2U, lowest ^ 4U};
}

} // namespace

std::array<PlaneCorner, manifold_points_max>
deepest_corners(const glm::dvec3& normal, const glm::dmat3& axes, const glm::dvec3& half)
{
    const std::array<glm::dvec3, 3> edge{half.x * axes[0], half.y * axes[1], half.z * axes[2]};
    const Triple rise{glm::dot(normal, edge[0]), glm::dot(normal, edge[1]),
                      glm::dot(normal, edge[2])};
    const Corners which = deepest(rise);
    std::array<PlaneCorner, manifold_points_max> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::uint32_t corner = which[i];
        const double x = (corner & 1U) != 0 ? 1.0 : -1.0;
        const double y = (corner & 2U) != 0 ? 1.0 : -1.0;
        const double z = (corner & 4U) != 0 ? 1.0 : -1.0;
        corners[i] = {x * edge[0] + y * edge[1] + z * edge[2],
                      x * rise[0] + y * rise[1] + z * rise[2], corner};
    }
    return corners;
}

std::array<PlaneCorner, manifold_points_max> lowest_points(const glm::dvec3& normal,
                                                           const OrientedBox& round)
{
    const glm::dvec3 core = round.half - round.rounding;
    const int axis = core.x > 0.0 ? 0 : core.y > 0.0 ? 1 : 2;
    const glm::dvec3 end = core[axis] * round.axes[axis];
    const double rise = glm::dot(normal, end);
    std::array<PlaneCorner, manifold_points_max> points;
    for (PlaneCorner& point : points) point.rise = std::numeric_limits<double>::max();
    points[0] = {-end - round.rounding * normal, -rise - round.rounding, 0};
    if (core[axis] > 0.0) points[1] = {end - round.rounding * normal, rise - round.rounding, 1};
    return points;
}

Manifold collide(const PlaneSurface& plane, const OrientedBox& box, double margin)
{
    const double height = glm::dot(plane.normal, box.centre) - plane.offset;
    Manifold manifold;
    manifold.normal = plane.normal;
    const auto corners = box.is_round() ? lowest_points(plane.normal, box)
                                        : deepest_corners(plane.normal, box.axes, box.half);
    for (const PlaneCorner& corner : corners) {
        const double separation = height + corner.rise;
        if (separation > margin) continue;
        manifold.points[manifold.count++] = {.position = box.centre + corner.place -
                                                         (0.5 * separation) * plane.normal,
                                             .separation = separation,
                                             .feature = corner.feature};
    }
    return manifold;
}

} // namespace hapnet::scene
