// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/hand/advance.hpp"
#include "scene/maths/lanes.hpp"

#include <span>

namespace hapnet::scene {

/// Advances a body by a tick in which no contact begins or ends, as in most ticks. One or two
/// springs press amid faces of the box from the start to the end, and the body turns evenly and
/// little. The effect is that of one phase of ContactPhases, with depths and impulses in closed
/// form. In any other tick the function returns false and leaves the body as it was. `work` is set,
/// not added to.
[[nodiscard]] bool advance_in_constant_contact(MovingBody& body, const BodyDynamics& dynamics,
                                               std::span<const HandSpring> springs,
                                               std::span<SpringImpulse> work, double tick,
                                               PressedModes& modes);

/// One or two springs that press amid faces, side by side. A single spring is stored twice.
struct PressingSprings {
    TwoVectors normal{}, arm{}, velocity{}; // see HandSpring
    Two radius{}, gap{};                    // see HandSpring
    Two stiffness{}, damping{}, force_max{};
    bool are_two = false;
};

/// As above, for these springs. It accepts only a tick in which the body turns by no more than
/// rounding. Then it is exact. `impulse` is the impulse on the body.
[[nodiscard]] bool advance_in_constant_contact(MovingBody& body, const BodyDynamics& dynamics,
                                               const PressingSprings& springs, double tick,
                                               PressedModes& modes, TwoVectors& impulse);

} // namespace hapnet::scene
