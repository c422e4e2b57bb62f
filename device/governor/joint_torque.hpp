// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/capabilities.hpp"
#include "proto/base/space.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::device {

/// Returns the largest share of this force, 0 to 1, that overloads no joint's motor. Torques are
/// the transposed Jacobian times the force. 0 where a torque is not finite, as at a position out of
/// reach.
[[nodiscard]] inline double share_that_joints_bear(const JointLimits& joints,
                                                   const base::Position& position,
                                                   const base::Force& force)
{
    const glm::dmat3 jacobian = joints.mechanism.jacobian(position);
    double share = 1.0;
    for (const int joint : {0, 1, 2}) {
        const glm::dvec3& moves = jacobian[joint]; // stylus motion per radian of this joint, m
        const double torque =
            std::abs(moves.x * force.value.x + moves.y * force.value.y + moves.z * force.value.z);
        if (!std::isfinite(torque)) return 0.0;
        const double most = joints.torque_max_nm[joint];
        if (torque > most) share = std::min(share, most / torque);
    }
    return share;
}

} // namespace hapnet::device
