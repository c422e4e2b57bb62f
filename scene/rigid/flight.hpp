// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bodies.hpp"

#include <glm/gtc/quaternion.hpp>

namespace hapnet::scene {

// The turning of a body between two touches within a tick.

/// The turn of a capsule about its own axis. It makes no difference to anything that the capsule
/// meets.
struct Roll {
    double rate = 0.0;  // rad/s
    double angle = 0.0; // rad: turned until `time`
    double time = 0.0;  // s

    void advance(double to)
    {
        angle += rate * (to - time);
        time = to;
    }
    void stop(double at)
    {
        advance(at);
        rate = 0.0;
    }
    [[nodiscard]] glm::dquat turned(const glm::dquat& orientation, const BodyProperties& body,
                                    double at) const;
};

/// Returns the steady spin (rad/s) that leads from one orientation to the other within a tick. It
/// makes as many full turns as the mean spin does. A body that turns by at most 0.2 rad in the tick
/// keeps the mean spin.
[[nodiscard]] glm::dvec3 steady_spin(const glm::dquat& from, const glm::dquat& to,
                                     const glm::dvec3& mean, double tick);

/// Returns the spin that a body has now in this orientation, rad/s. With unequal moments of inertia
/// the spin changes on the way. A capsule is a symmetric top: its axis turns steadily about its
/// angular momentum. For a capsule the result is the spin of its axis, and `roll` gets the rest.
[[nodiscard]] glm::dvec3 spin_of(const Bodies& bodies, Slot slot, const glm::dquat& orientation,
                                 Roll& roll);

} // namespace hapnet::scene
