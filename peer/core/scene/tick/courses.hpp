// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/scene/contact/manifold.hpp"
#include "peer/core/scene/solver/contact_solver.hpp"
#include "peer/core/scene/stage.hpp"

namespace hapnet::scene {

/// What is small in this scene: everything is measured against it.
struct Scales {
    double tick = 1e-3;  // s
    double size = 0.02;  // m: the smallest half edge of a movable body
    double fall = 0.0;   // m/s: what gravity adds in a tick
    double speed = 1e-2; // m/s: the above, or what crosses a millionth of the size in a tick
};
[[nodiscard]] Scales scales_of(const Frozen& frozen, const Bodies& bodies);

/// A body's way through a tick.
struct BodyCourse {
    glm::dvec3 impulse{0.0}; // of last tick's contacts, taken as constant forces
    glm::dvec3 angular_impulse{0.0};
    BodyMotion start;
    BodyMotion tentative;             // at the end, without what contacts change
    BodyMotion mean;                  // over the tick, likewise
    glm::dvec3 angular_momentum{0.0}; // at the end, likewise
    std::uint32_t rubbing = 0;        // contacts with friction that push
};

[[nodiscard]] OrientedBox box_of(const Bodies& bodies, Slot slot);
[[nodiscard]] BodyResponse response_of(const BodyForm& form, const OrientedBox& box);

/// Gravity, pushes and last tick's contact impulses, without hands: a parabola.
void follow(BodyCourse& course, const Stage& stage, Slot slot, const BodyResponse& response,
            const Frozen& frozen);

/// A contact that stops slipping within the tick does so at its moment: until then friction has
/// its full strength, and not a mean one until the end. For a body whose only friction it is.
void stop_in_time(const ContactBlock& block, const BodyCourse& course, const BodyForm& form,
                  const Scales& scales, BodyMotion& mean);

/// Moves the body by what was solved.
void arrive(const BodyCourse& course, Bodies& bodies, Slot slot, ContactSolver& solver,
            double tick);

} // namespace hapnet::scene
