// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/manifold.hpp"
#include "scene/hand/advance.hpp"
#include "scene/solver/contact_solver.hpp"
#include "scene/state.hpp"

#include <span>

namespace hapnet::scene {

/// One body's integration over a tick.
struct BodyIntegration {
    glm::dvec3 contact_impulse{0.0}; // of last tick's contacts, taken as constant forces
    glm::dvec3 contact_angular_impulse{0.0};
    BodyMotion start;
    BodyMotion predicted;                        // at the end, without what contacts change
    BodyMotion mean;                             // over the tick, likewise
    glm::dvec3 angular_momentum{0.0};            // at the end, likewise
    BodyMotion start_after_bounces;              // at the start, as if it had bounced before
    glm::dvec3 bounce_angular_impulse{0.0};      // angular impulse of bounces
    glm::dvec3 bounce_angular_impulse_mean{0.0}; // ... its mean over the tick
    std::uint32_t friction_contacts = 0;         // contacts with friction that push
    double drag = 0.0;                           // 1/s, on the plane that supports it
    glm::dvec3 support_normal{0.0};              // its normal

    // Where a body with hands on it would be at the end.
    bool has_hands = false;
    glm::dvec3 position{0.0};
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
};

[[nodiscard]] BodyResponse response_of(const BodyProperties& properties, const OrientedBox& box);

/// Starts with nothing acting on the body.
void reset(BodyIntegration& integration);

/// The springs on one body.
struct HandForces {
    std::span<const HandSpring> springs;
    std::span<SpringImpulse> work;
    const WorldConfig& config;
};

/// Gravity, pushes and last tick's contact impulses, without hands: a parabola.
void integrate_velocity(BodyIntegration& integration, const WorldState& state, Slot slot,
                        const BodyResponse& response, const WorldConfig& config);

/// The same with the hands' springs on it, which tell their work.
void integrate_velocity_with_hands(BodyIntegration& integration, const WorldState& state, Slot slot,
                                   const BodyResponse& response, const HandForces& hands);

/// What slides on something that does not turn.
struct SlidingBody {
    const BodyIntegration& integration;
    const glm::dvec3& ground; // the velocity of what it slides on
    bool is_second = true;    // of the contact
};

/// A contact that stops slipping within the tick does so at its moment: until then friction has
/// its full strength, and not a mean one until the end. For a body whose only friction it is.
void apply_stop(const ContactBlock& block, const SlidingBody& body,
                const BodyProperties& properties, const Scales& scales, BodyMotion& mean);

/// A body's contacts were looked for in the box around its straight path through the tick. When it
/// is thrown far out of that, it goes only as far as it cannot pass through anything that was not
/// looked for, and responds to nothing more. Returns whether any body was.
bool keep_within_swept_path(std::span<const Slot> slots,
                            std::span<const BodyIntegration> integrations, ContactSolver& solver,
                            const Scales& scales);

/// Moves the body by the mean velocity that was solved for.
void integrate_position(const BodyIntegration& integration, Bodies& bodies, Slot slot,
                        ContactSolver& solver, const Scales& scales);

} // namespace hapnet::scene
