// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/manifold.hpp"
#include "scene/hand/advance.hpp"
#include "scene/hand/friction.hpp"
#include "scene/maths/vector.hpp"
#include "scene/rigid/driven_energy.hpp"
#include "scene/solver/contact_solver.hpp"
#include "scene/state.hpp"

#include <limits>
#include <span>

namespace hapnet::scene {

/// The first touch of a body that goes far in a tick, on the path that it began.
struct FirstTouch {
    double time = std::numeric_limits<double>::infinity(); // s, within the tick
    glm::dvec3 normal{0.0};                                // from the body to the other
    PartId other = 0;
    PartId own = 0;
};

/// One body's integration over a tick.
struct BodyIntegration {
    glm::dvec3 contact_impulse{0.0}; // last tick's contact impulses, taken as constant forces
    glm::dvec3 contact_angular_impulse{0.0};
    BodyMotion start;
    // Without the changes that the solver makes in the contacts:
    BodyMotion predicted;             // at the end of the tick
    BodyMotion mean;                  // mean over the tick
    glm::dvec3 angular_momentum{0.0}; // at the end of the tick

    BodyMotion start_after_bounces;              // motion at the start plus what bounces changed
    BodyMotion bounce_offset;                    // m, rad: shift of the start for that motion
    double last_bounce = 0.0;                    // s, from the start of the tick
    glm::dvec3 bounce_angular_impulse{0.0};      // sum over the bounces
    glm::dvec3 bounce_angular_impulse_mean{0.0}; // its mean over the tick
    std::uint32_t friction_contacts = 0;         // number of contacts with friction that push
    double drag = 0.0;                           // 1/s, by the plane that supports it
    glm::dvec3 support_normal{0.0};              // normal of the plane with drag
    FirstTouch first_touch;                      // first touch among the bodies on its way
    double least_near = 0.0; // m: the smallest half edge of the body and of what it may meet
    DrivenEnergy driven{};   // work of kinematic bodies in contacts

    // The body's place and energy before it moved: see IslandEnergy.
    glm::dvec3 start_position{0.0};
    glm::dquat start_orientation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 start_angular_momentum{0.0};
    double start_energy = 0.0; // J: kinetic energy

    // The place at the end of a body with hands on it.
    bool has_hands = false;
    bool hands_are_braked = false;
    std::size_t hand_rows = 0; // see HandEnergy
    double own_work = 0.0;     // J: work of the hands on it, less the work that drag took
    glm::dvec3 position{0.0};
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
    BodyMotion mean_to_there; // mean motion that leads to that place
};

[[nodiscard]] BodyResponse response_of(const BodyProperties& properties, const glm::dmat3& axes);

/// Starts with nothing acting on the body.
void reset(BodyIntegration& integration);

/// As reset(), but in the middle of a tick, for a body that is solved again. It keeps only the
/// effect of a torque.
void begin_again(BodyIntegration& integration, const glm::dvec3& twist);

/// Starts with no bounce yet.
void begin_bounces(BodyIntegration& integration);

/// The springs on one body.
struct HandForces {
    std::span<const HandSpring> springs;
    std::span<SpringImpulse> work;
    PressedModes& modes;
    const WorldConfig& config;
    std::span<FrictionSpring> frictions{}; // empty: no spring has friction
};

/// Integrates gravity, pushes and last tick's contact impulses, without hands: a parabola.
void integrate_velocity(BodyIntegration& integration, const WorldState& state, Slot slot,
                        const BodyResponse& response, const WorldConfig& config);

/// The effect of a change of a body's velocity at a time within the tick: the change that remains
/// at the end, and the part that it adds to the mean velocity. On a plane that supports the body,
/// drag reduces the change like any velocity.
struct VelocityChange {
    glm::dvec3 at_end{0.0};
    glm::dvec3 mean{0.0};
};
[[nodiscard]] VelocityChange change_within(const BodyIntegration& integration,
                                           const BodyResponse& response, const glm::dvec3& change,
                                           double share_left, double tick);

/// Returns everything that acts on a body with hands on it, except the hands.
[[nodiscard]] BodyDynamics dynamics_of(const BodyIntegration& integration, const WorldState& state,
                                       Slot slot, const BodyResponse& response,
                                       const WorldConfig& config);

/// As integrate_velocity(), with the hands' springs on the body. The springs report their work.
void integrate_velocity_with_hands(BodyIntegration& integration, const WorldState& state, Slot slot,
                                   const BodyResponse& response, const HandForces& hands);

/// A body that slides on something that does not turn.
struct SlidingBody {
    const BodyIntegration& integration;
    const glm::dvec3& ground; // velocity of the surface that it slides on
    bool is_second = true;    // the body is the second of the contact
};

/// Corrects the mean velocity of a body whose contact ceases to slip within the tick, so that it
/// stops at the exact moment. Until then friction has its full strength, instead of a mean strength
/// until the end. The contact must be the body's only friction.
void apply_stop(const ContactBlock& block, const SlidingBody& body,
                const BodyProperties& properties, const Scales& scales, BodyMotion& mean);

/// Calls apply_stop() for all bodies with only one such contact, once the impulses are known.
void stop_sliding_contacts(const Bodies& bodies, const Scales& scales, ContactSolver& solver,
                           std::span<const BodyIntegration> integrations);

/// Sums up last tick's contact impulses on each body. They count as constant forces, so a body that
/// rests or slides straight on is in balance before the solver starts.
void warm_start(ContactSolver& solver, std::span<BodyIntegration> integrations);

/// A body could pass through something if it moves farther than this in a tick, in half edges of
/// the smallest body near it.
inline constexpr double far_way = 0.5;

/// The results of keep_within_swept_path().
struct Ways {
    bool any_kept = false; // some body was held back
    bool any_far = false;  // some body goes far, turning included: ContinuousCollision has work
};

/// True if a body that meets only planes goes far in a tick, turning included.
[[nodiscard]] inline bool goes_far(const BodyProperties& body, const BodyMotion& mean,
                                   const Scales& scales)
{
    return sum_of_sizes(mean.velocity) + sum_of_sizes(body.half) * sum_of_sizes(mean.spin) >
           far_way * body.least_half * scales.rate;
}

/// Limits the mean motion to the range between the motions at the start and at the end of the tick.
/// When the correction of overlaps throws a body far out of that range, the body goes only as far
/// as it can without passing through anything, and no longer responds to impulses.
Ways keep_within_swept_path(const WorldState& state, std::span<const Slot> slots,
                            std::span<const BodyIntegration> integrations, ContactSolver& solver,
                            const Scales& scales);

/// Returns the spin with which integrate_position() will turn the body steadily through the tick.
/// It is not valid for a body with hands on it.
[[nodiscard]] glm::dvec3 spin_through_tick(const BodyIntegration& integration, const Bodies& bodies,
                                           Slot slot, const BodyMotion& mean, double tick);

/// The position and orientation to which integrate_position() will move the body.
struct Placement {
    glm::dvec3 position{0.0};
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
};
[[nodiscard]] Placement placement_at_end(const BodyIntegration& integration, const Bodies& bodies,
                                         Slot slot, const BodyMotion& mean, double tick);

/// Moves the body by the mean velocity that the solver found.
void integrate_position(const BodyIntegration& integration, Bodies& bodies, Slot slot,
                        ContactSolver& solver, const Scales& scales);

} // namespace hapnet::scene
