// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/description.hpp"
#include "scene/hand/advance.hpp"

#include <cmath>
#include <span>

namespace hapnet::scene {

/// The dry friction of a hand's spring. A second spring and damper, as stiff as those across the
/// surface, pulls the hand along the surface towards a proxy on it. The proxy stays where it is
/// while the pull is within the cone of friction, and follows the hand otherwise (V. Hayward and B.
/// Armstrong, A new computational model of friction applied to haptic rendering, 2000; CHAI3D's
/// friction proxy). The proxy moves with the body.
struct FrictionSpring {
    HandFriction limits{};   // shares of the force across the surface; 0: no friction
    glm::dvec3 stretch{0.0}; // from the proxy to the hand, along the surface, at the start
    bool slides = false;     // at the start of the tick, and afterwards at its end
    glm::dvec3 slid{0.0};    // how far the proxy slid over the surface in the tick

    [[nodiscard]] double limit() const { return slides ? limits.sliding : limits.sticking; }
};

/// Returns the greatest push along the normal of a surface, N, at which push and friction together
/// do not exceed the contact's greatest force.
[[nodiscard]] inline double push_max(double force_max, const HandFriction& limits)
{
    return force_max / std::sqrt(1.0 + limits.sticking * limits.sticking);
}

/// A body's springs, their friction and their work. All three have the same length.
struct FrictionContacts {
    std::span<const HandSpring> springs;
    std::span<FrictionSpring> frictions;
    std::span<SpringImpulse> work;
};

/// Does the work of advance() where some springs have friction. It uses the implicit midpoint rule
/// throughout, and cuts a pull that leaves the cone of friction to the cone. The rule loses the
/// energy that friction takes and gains none, however stiff the springs are. Energy that turning
/// directions add is removed as in advance().
HandEnergy advance_with_friction(MovingBody& body, const BodyDynamics& dynamics,
                                 const FrictionContacts& contacts, double tick);

/// A hand's friction on something that moves evenly through the tick, whatever the hand does.
struct Rub {
    double stiffness = 0.0;
    double damping = 0.0;
    glm::dvec3 velocity{0.0}; // velocity of the hand over the surface, along it
    double impulse = 0.0;     // N s: impulse across the surface
    double tick = 0.0;
};

/// Returns the impulse on the hand, N s, with the mean force across the surface. It is exact while
/// that force is steady and the hand slides on in its direction, also in the tick in which it
/// begins to slide.
[[nodiscard]] glm::dvec3 rub_evenly(const Rub& rub, FrictionSpring& friction);

} // namespace hapnet::scene
