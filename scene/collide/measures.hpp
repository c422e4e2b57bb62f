// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/manifold.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::scene {

/// Half the length of a box's shadow along a direction, times the direction's length.
[[nodiscard]] inline double half_projection(const OrientedBox& box, const glm::dvec3& direction)
{
    return box.half.x * std::abs(glm::dot(direction, box.axes[0])) +
           box.half.y * std::abs(glm::dot(direction, box.axes[1])) +
           box.half.z * std::abs(glm::dot(direction, box.axes[2]));
}

/// What tolerances are relative to.
[[nodiscard]] inline double smallest_half(const OrientedBox& a, const OrientedBox& b)
{
    return std::min({a.half.x, a.half.y, a.half.z, b.half.x, b.half.y, b.half.z});
}

} // namespace hapnet::scene
