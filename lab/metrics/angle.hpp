// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace hapnet::lab::metrics {

/// Returns the angle of the rotation from one orientation to the other, radians from 0 to pi.
[[nodiscard]] inline double angle_between(const glm::dquat& a, const glm::dquat& b)
{
    // The imaginary part keeps small angles precise, and |w| makes q and -q equal.
    const glm::dquat turn = glm::conjugate(a) * b;
    const double sine = std::sqrt(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z);
    return 2.0 * std::atan2(sine, std::abs(turn.w));
}

} // namespace hapnet::lab::metrics
