// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>

namespace hapnet::scene {

/// One number per axis: x, y, z. Unlike a glm vector's, its index costs no branch.
using PerAxis = std::array<double, 3>;

[[nodiscard]] inline PerAxis per_axis(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
[[nodiscard]] inline glm::dvec3 vector(const PerAxis& a) { return {a[0], a[1], a[2]}; }
[[nodiscard]] inline double dot(const PerAxis& a, const PerAxis& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

} // namespace hapnet::scene
