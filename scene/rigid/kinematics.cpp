// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/kinematics.hpp"

#include "scene/rigid/driven_energy.hpp"

#include "proto/base/math.hpp"
#include "scene/maths/rotation.hpp"
#include "scene/maths/vector.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::scene {

namespace {

bool is_at_rest(const BodyMotion& motion)
{
    return motion.velocity == glm::dvec3{0.0} && motion.spin == glm::dvec3{0.0};
}

/// Returns how far a change agrees with the mean of the changing quantity: 1 where the mean is
/// midway, 0 where it is so far off that the quantity would have to become faster or slower than at
/// both ends.
double agreement(const glm::dvec3& start, const glm::dvec3& mean, const glm::dvec3& end)
{
    const double gain = length(end - start);
    const double off = length(start + end - 2.0 * mean);
    return off < gain ? 1.0 - off / gain : 0.0;
}

/// Returns the phase at a time in a period: 0..1.
double phase_at(double time, double period)
{
    const double turns = time / period;
    return turns - std::floor(turns);
}

} // namespace

BodyMotion KinematicTick::motion_at(double time, double tick) const
{
    const double share = time / tick - 0.5;
    return {mean.velocity + share * change.velocity, mean.spin + share * change.spin,
            glm::dvec3{0.0}};
}

void Kinematics::begin_tick(const WorldConfig& config, WorldState& state)
{
    Bodies& bodies = state.bodies;
    const double tick = config.tick;
    ticks_.resize(state.scripts.size());
    any_far_ = false;
    for (Slot slot = bodies.movable; slot < bodies.moving; ++slot) {
        KinematicTick& now = ticks_[slot - bodies.movable];
        KinematicScript& script = state.scripts[slot - bodies.movable];
        const glm::dvec3 from = bodies.position.at(slot);
        const glm::dquat turned = bodies.orientation.at(slot);
        now.start = {bodies.velocity.at(slot), bodies.angular_momentum.at(slot), glm::dvec3{0.0}};
        now.end = now.mean = now.start;
        bool is_placed = false;
        now.position = {from + tick * now.start.velocity};
        now.orientation = is_at_rest(now.start) ? turned : rotated(turned, tick * now.start.spin);
        switch (script.kind) {
        case KinematicScript::Kind::steady: break;
        case KinematicScript::Kind::sways: {
            const double period = base::to_seconds(script.sway.period);
            const double angle =
                base::two_pi * phase_at(tick * static_cast<double>(state.ticks + 1), period);
            now.position.value =
                script.target.position.value + (0.5 * (1.0 - base::cos(angle))) * script.sway.by;
            now.end.velocity = (0.5 * base::two_pi / period * base::sin(angle)) * script.sway.by;
            now.mean.velocity = (now.position.value - from) / tick;
            break;
        }
        case KinematicScript::Kind::target:
            now.position = script.target.position;
            now.orientation = script.target.orientation;
            now.end.velocity = script.target.velocity.value;
            now.end.spin = script.target.angular_velocity;
            now.mean.velocity = (now.position.value - from) / tick;
            now.mean.spin = turn_between(turned, now.orientation) / tick;
            script.kind = KinematicScript::Kind::steady;
            is_placed = true;
            break;
        }
        now.change.velocity = now.end.velocity - now.start.velocity;
        now.change.spin = now.end.spin - now.start.spin;
        if (is_placed) {
            now.change.velocity *=
                agreement(now.start.velocity, now.mean.velocity, now.end.velocity);
            now.change.spin *= agreement(now.start.spin, now.mean.spin, now.end.spin);
        }
        now.moves = !is_at_rest(now.start) || !is_at_rest(now.mean) || !is_at_rest(now.end);
        const double across = length(bodies.properties[slot].half);
        any_far_ = any_far_ || length(now.mean.velocity) + across * length(now.mean.spin) >
                                   far_way * scales_.size * scales_.rate;
        bodies.velocity.put(slot, now.mean.velocity);
        bodies.angular_momentum.put(slot, now.mean.spin);
    }
}

void Kinematics::begin_contacts(const Bodies& bodies, ContactSolver& solver,
                                std::span<BodyIntegration> integrations) const
{
    for (Slot slot = bodies.movable; slot < bodies.moving; ++slot) {
        const SolverIndex index = bodies.awake + 1 + (slot - bodies.movable);
        const KinematicTick& now = of(bodies, slot);
        BodyIntegration& integration = integrations[index];
        integration = {};
        integration.start = integration.start_after_bounces = now.start;
        integration.predicted = solver.end_motion(index) = now.end;
        integration.mean = solver.mean_motion(index) = now.mean;
        solver.response(index) = {};
    }
}

namespace {

/// The vectors from the centres of two touching bodies to the place of the touch.
struct Arms {
    const glm::dvec3& of_body;
    const glm::dvec3& of_surface;
};

} // namespace

void add_driven_energy(ContactSolver& solver, std::span<BodyIntegration> integrations)
{
    const auto add = [&](SolverIndex body, SolverIndex by, const Arms& arms, const Wrench& push) {
        if (is_nothing(push)) return; // then the speed of the surface does not count either
        const BodyMotion& start = integrations[body].start;
        const BodyMotion& end = solver.end_motion(body);
        const double taken =
            0.5 * (work_of(push, arms.of_body, start) + work_of(push, arms.of_body, end));
        const BodyMotion& mean = integrations[by].mean;
        const BodyMotion& at_end = integrations[by].predicted;
        const double given =
            std::max(work_of(push, arms.of_surface, mean), work_of(push, arms.of_surface, at_end));
        integrations[body].driven.add(
            {driven_energy(given, taken), std::max(length(velocity_at(mean, arms.of_surface)),
                                                   length(velocity_at(at_end, arms.of_surface)))});
    };
    for (const ContactBlock& block : solver.blocks()) {
        const bool a_drives = solver.is_kinematic(block.a);
        if (!a_drives && !solver.is_kinematic(block.b)) continue;
        const Wrench on_b = wrench(block, contact_vector(block, block.impulse));
        if (a_drives)
            add(block.b, block.a, {block.arm_b, block.arm_a}, on_b);
        else
            add(block.a, block.b, {block.arm_a, block.arm_b}, {-on_b.impulse, -on_b.angular});
    }
}

void Kinematics::end_tick(WorldState& state)
{
    Bodies& bodies = state.bodies;
    for (Slot slot = bodies.movable; slot < bodies.moving; ++slot) {
        const KinematicTick& now = ticks_[slot - bodies.movable];
        bodies.position.put(slot, now.position.value);
        bodies.orientation.put(slot, now.orientation);
        bodies.velocity.put(slot, now.end.velocity);
        bodies.angular_momentum.put(slot, now.end.spin);
    }
}

} // namespace hapnet::scene
