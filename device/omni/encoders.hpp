// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/omni/geometry.hpp"
#include "proto/base/math.hpp"

#include <glm/vec3.hpp>

namespace hapnet::device::omni {

/// The counts of the three joints' encoders. They count from their position when the power was
/// switched on. Only the inkwell shows where that was.
using Counts = glm::ivec3;

inline constexpr double radians_per_count = base::two_pi / 15000.0;
/// The signs of the encoders: the shoulder's counts in the opposite direction.
inline constexpr glm::dvec3 encoder_signs{1.0, -1.0, 1.0};

/// Returns the angles of the joints. `zero` is the encoders' angle where the joint's angle is 0.
[[nodiscard]] inline Joints joints_at(const Counts& counts, const Joints& zero)
{
    return {radians_per_count * encoder_signs * glm::dvec3{counts} - zero.angles};
}

/// Returns the zero of the encoders from their counts with the stylus in the inkwell.
[[nodiscard]] inline Joints zero_from(const Counts& in_inkwell, const Joints& pose = inkwell_pose)
{
    return {radians_per_count * encoder_signs * glm::dvec3{in_inkwell} - pose.angles};
}

/// Returns the counts nearest to these angles.
[[nodiscard]] inline Counts counts_at(const Joints& joints, const Joints& zero)
{
    const glm::dvec3 exact = encoder_signs * (joints.angles + zero.angles) / radians_per_count;
    Counts counts{0};
    for (const int axis : {0, 1, 2}) {
        counts[axis] = static_cast<int>(exact[axis] + (exact[axis] < 0.0 ? -0.5 : 0.5));
    }
    return counts;
}

} // namespace hapnet::device::omni
