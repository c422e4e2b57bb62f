// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/governor/limits.hpp"
#include "proto/base/space.hpp"

namespace hapnet::device {

/// The width of the zone outside of the workspace in which the outward part of a force decreases
/// linearly to zero, so that the force does not chatter at the border. No device is to push the
/// hand farther out.
inline constexpr double workspace_margin_m = 0.005;

[[nodiscard]] inline bool is_inside(const GovernorLimits& limits, const base::Position& hip)
{
    const glm::dvec3& low = limits.workspace_min.value;
    const glm::dvec3& high = limits.workspace_max.value;
    const glm::dvec3& p = hip.value;
    return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y && p.z >= low.z &&
           p.z <= high.z;
}

/// Returns the distance of a position beyond the border on the side to which this part of the force
/// points.
[[nodiscard]] inline double beyond(const GovernorLimits& limits, const base::Position& hip,
                                   int axis, double along)
{
    return along > 0.0 ? hip.value[axis] - limits.workspace_max.value[axis]
                       : limits.workspace_min.value[axis] - hip.value[axis];
}

/// Returns the force that remains at a position outside of the workspace, axis by axis.
[[nodiscard]] inline base::Force
with_outward_part_faded(const GovernorLimits& limits, const base::Position& hip, base::Force force)
{
    for (const int axis : {0, 1, 2}) {
        double& along = force.value[axis];
        const double depth = beyond(limits, hip, axis, along);
        if (depth > 0.0) along *= depth < workspace_margin_m ? 1.0 - depth / workspace_margin_m : 0;
    }
    return force;
}

/// Removes the outward part of a force beyond the margin, at any speed of the hand.
[[nodiscard]] inline base::Force with_outward_part_cut(const GovernorLimits& limits,
                                                       const base::Position& hip, base::Force force)
{
    for (const int axis : {0, 1, 2}) {
        double& along = force.value[axis];
        if (beyond(limits, hip, axis, along) >= workspace_margin_m) along = 0.0;
    }
    return force;
}

} // namespace hapnet::device
