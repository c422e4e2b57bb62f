// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/time_of_impact.hpp"
#include "scene/state.hpp"

#include <glm/gtc/quaternion.hpp>

namespace hapnet::scene {

// How a body flies between two touches within a tick.

/// The same motion, but at `time` it is there and turned so.
void set_place(SteadyBox& flight, const glm::dvec3& centre, const glm::dquat& orientation,
               double time);
[[nodiscard]] glm::dquat orientation_at(const SteadyBox& flight, double time);

/// Gravity and pushes: what acts on an awake body steadily through the tick, as an acceleration.
[[nodiscard]] glm::dvec3 steady_acceleration(const WorldConfig& config, const WorldState& state,
                                             Slot slot);

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
    [[nodiscard]] glm::dquat turned(const glm::dquat& orientation, const BodyProperties& body,
                                    double at) const;
};

/// The spin that a body turned so has now. With unequal moments of inertia it does not stay; but a
/// capsule is a symmetric top: its axis turns steadily about its angular momentum. Of that it is
/// the spin, and `roll` gets the rest.
[[nodiscard]] glm::dvec3 spin_of(const Bodies& bodies, Slot slot, const glm::dquat& orientation,
                                 Roll& roll);

} // namespace hapnet::scene
