// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/hand/advance.hpp"

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

} // namespace hapnet::scene
