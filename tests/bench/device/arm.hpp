// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/math.hpp"
#include "proto/base/space.hpp"

#include <cmath>
#include <glm/mat3x3.hpp>

namespace hapnet::bench {

// An arm of an Omni's kind, of which the bench needs the cost: a waist that turns about the
// vertical, a shoulder, an elbow, and two links. The one place to put a device's own in.

inline constexpr double link_m = 0.133;
inline constexpr glm::dvec3 shoulder_m{0.0, -0.02, -0.17};

/// Where the stylus is, by the angles of waist, shoulder and elbow.
[[nodiscard]] inline base::Position stylus_at(const glm::dvec3& angles)
{
    const double reach = link_m * (base::cos(angles.y) + base::cos(angles.z));
    const double height = link_m * (base::sin(angles.y) + base::sin(angles.z));
    return {shoulder_m +
            glm::dvec3{reach * base::sin(angles.x), height, reach * base::cos(angles.x)}};
}

/// How the stylus moves with each angle, from where it is: the elbow by the law of cosines.
[[nodiscard]] inline glm::dmat3 arm_jacobian(const base::Position& position)
{
    const glm::dvec3 v = position.value - shoulder_m;
    const double reach = std::sqrt(v.x * v.x + v.z * v.z);
    const double side = v.x / reach;
    const double front = v.z / reach;
    const double half = 0.5 * std::sqrt(reach * reach + v.y * v.y);
    const double bend = std::sqrt(std::max(0.0, link_m * link_m - half * half)) / (2.0 * half);
    const double upper_reach = 0.5 * reach - bend * v.y; // the elbow's
    const double upper_height = 0.5 * v.y + bend * reach;
    const double fore_reach = reach - upper_reach;
    const double fore_height = v.y - upper_height;
    return {glm::dvec3{v.z, 0.0, -v.x},
            glm::dvec3{-upper_height * side, upper_reach, -upper_height * front},
            glm::dvec3{-fore_height * side, fore_reach, -fore_height * front}};
}

} // namespace hapnet::bench
