// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/hand/advance.hpp"

#include <cmath>
#include <span>

namespace hapnet::scene {

/// Advances a body by a tick in which nothing begins and nothing ends, which is what most ticks
/// are: one or two springs press amid faces of the box from the start to the end, and it turns
/// evenly and little. What ContactPhases does in one phase, with depths and impulses in closed
/// form. False, and the body has not changed, when
/// it is not so; `work` is set and not added to.
[[nodiscard]] bool advance_in_constant_contact(MovingBody& body, const BodyDynamics& dynamics,
                                               std::span<const HandSpring> springs,
                                               std::span<SpringImpulse> work, double tick,
                                               PressedModes& modes);

/// So little that the directions of springs are what they were, to rounding: then what that did is
/// exact.
[[nodiscard]] inline bool has_hardly_turned(const MovingBody& start, const MovingBody& end)
{
    constexpr double hardly = 5e-11; // half of the angle
    const glm::dquat& from = start.orientation;
    const glm::dquat& to = end.orientation;
    return std::abs(to.x - from.x) + std::abs(to.y - from.y) + std::abs(to.z - from.z) <= hardly;
}

} // namespace hapnet::scene
