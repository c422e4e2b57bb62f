// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace hapnet::scene {

/// Returns the length by a correctly rounded square root: the same bits everywhere.
[[nodiscard]] inline double length(const glm::dvec3& v) { return std::sqrt(glm::dot(v, v)); }

/// The sum of the components' sizes: not less than the length, and no root to take.
[[nodiscard]] inline double sum_of_sizes(const glm::dvec3& v)
{
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

/// The absolute value of each component. Unlike glm's abs, it costs no compares.
[[nodiscard]] inline glm::dvec3 sizes(const glm::dvec3& v)
{
    return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}

/// A unit vector along x (0), y or z.
[[nodiscard]] inline glm::dvec3 axis_of_world(int axis)
{
    glm::dvec3 direction{0.0};
    direction[axis] = 1.0;
    return direction;
}

/// True if no component is larger than `most` or NaN.
[[nodiscard]] inline bool is_within(const glm::dvec3& v, double most)
{
    return std::abs(v.x) <= most && std::abs(v.y) <= most && std::abs(v.z) <= most;
}

/// One number per axis: x, y, z. Unlike a glm vector's, its index costs no branch.
using PerAxis = std::array<double, 3>;

[[nodiscard]] inline PerAxis per_axis(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
[[nodiscard]] inline glm::dvec3 vector(const PerAxis& a) { return {a[0], a[1], a[2]}; }
[[nodiscard]] inline double dot(const PerAxis& a, const PerAxis& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

} // namespace hapnet::scene
