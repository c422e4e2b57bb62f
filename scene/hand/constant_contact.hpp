// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/hand/advance.hpp"
#include "scene/maths/lanes.hpp"

#include <span>

namespace hapnet::scene {

/// Advances a body by a tick in which nothing begins and nothing ends, which is what most ticks
/// are: one or two springs press amid faces of the box from the start to the end, and it turns
/// evenly and little. It has the effect of one phase of ContactPhases, with depths and impulses in
/// closed form. In another tick it returns false and leaves the body as it was. `work` is set and
/// not added to.
[[nodiscard]] bool advance_in_constant_contact(MovingBody& body, const BodyDynamics& dynamics,
                                               std::span<const HandSpring> springs,
                                               std::span<SpringImpulse> work, double tick,
                                               PressedModes& modes);

/// One or two springs that press amid faces, side by side; where there is one, it stands twice.
struct PressingSprings {
    TwoVectors normal{}, arm{}, velocity{}; // see HandSpring
    Two radius{}, gap{};                    // see HandSpring
    Two stiffness{}, damping{}, force_max{};
    bool are_two = false;
};

/// As above, for these springs. It accepts only a tick in which the body turns by no more than
/// rounding; then it is exact. `impulse` is the impulse on the body.
[[nodiscard]] bool advance_in_constant_contact(MovingBody& body, const BodyDynamics& dynamics,
                                               const PressingSprings& springs, double tick,
                                               PressedModes& modes, TwoVectors& impulse);

} // namespace hapnet::scene
