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

/// Returns the sum of the components' sizes. It is not less than the length, and needs no root.
[[nodiscard]] inline double sum_of_sizes(const glm::dvec3& v)
{
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

/// Returns the absolute value of each component. Unlike glm's abs, it costs no comparisons.
[[nodiscard]] inline glm::dvec3 sizes(const glm::dvec3& v)
{
    return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}

/// Returns a unit vector along x (0), y (1) or z (2).
[[nodiscard]] inline glm::dvec3 axis_of_world(int axis)
{
    glm::dvec3 direction{0.0};
    direction[axis] = 1.0;
    return direction;
}

/// True if no component is larger in size than `most` or NaN.
[[nodiscard]] inline bool is_within(const glm::dvec3& v, double most)
{
    return std::abs(v.x) <= most && std::abs(v.y) <= most && std::abs(v.z) <= most;
}

/// One number per axis: x, y, z. Unlike an index into a glm vector, its index costs no branch.
using PerAxis = std::array<double, 3>;

[[nodiscard]] inline PerAxis per_axis(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
[[nodiscard]] inline glm::dvec3 vector(const PerAxis& a) { return {a[0], a[1], a[2]}; }
[[nodiscard]] inline double dot(const PerAxis& a, const PerAxis& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

} // namespace hapnet::scene
