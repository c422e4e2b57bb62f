// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bodies.hpp"

#include <glm/gtc/quaternion.hpp>

namespace hapnet::scene {

// How a body turns between two touches within a tick.

/// The turn of a capsule about its own axis, which nothing that it meets can tell.
struct Roll {
    double rate = 0.0;  // rad/s
    double angle = 0.0; // rad, until `time`
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

/// The steady spin that leads from one orientation to another in a tick, next to the mean spin:
/// what turns far tumbles on its way.
[[nodiscard]] glm::dvec3 steady_spin(const glm::dquat& from, const glm::dquat& to,
                                     const glm::dvec3& mean, double tick);

/// The spin that a body turned so has now. With unequal moments of inertia it does not stay; but a
/// capsule is a symmetric top: its axis turns steadily about its angular momentum. Of that it is
/// the spin, and `roll` gets the rest.
[[nodiscard]] glm::dvec3 spin_of(const Bodies& bodies, Slot slot, const glm::dquat& orientation,
                                 Roll& roll);

} // namespace hapnet::scene
