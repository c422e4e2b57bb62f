// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace hapnet::scene {

/// By a correctly rounded square root: the same bits everywhere.
[[nodiscard]] inline double length(const glm::dvec3& v) { return std::sqrt(glm::dot(v, v)); }

/// The sum of the components' sizes: not less than the length, and no root to take.
[[nodiscard]] inline double sum_of_sizes(const glm::dvec3& v)
{
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

} // namespace hapnet::scene
