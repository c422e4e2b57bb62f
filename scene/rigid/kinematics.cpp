// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/kinematics.hpp"

#include "proto/base/math.hpp"
#include "scene/maths/rotation.hpp"

#include <cmath>

namespace hapnet::scene {

namespace {

/// The angle of which this is the tangent, for at most an eighth of a turn: halved twice, then its
/// series.
double small_arc_tangent(double tangent)
{
    double x = tangent;
    for (int halving = 0; halving < 2; ++halving) x /= 1.0 + std::sqrt(1.0 + x * x);
    constexpr int terms = 12;
    double sum = 0.0;
    for (int n = terms; n-- > 0;) sum = 1.0 / (2.0 * n + 1.0) - x * x * sum;
    return 4.0 * x * sum;
}

/// The shortest turn from one orientation to another: radians about an axis of the world.
glm::dvec3 turn_between(const glm::dquat& from, const glm::dquat& to)
{
    glm::dquat by = to * glm::conjugate(from);
    if (by.w < 0.0) by = -by;
    const glm::dvec3 part{by.x, by.y, by.z};
    const double sine = std::sqrt(part.x * part.x + part.y * part.y + part.z * part.z);
    if (sine == 0.0) return part;
    // A quarter of the turn has the tangent sine / (1 + w): a turn has four of them.
    return (4.0 * small_arc_tangent(sine / (1.0 + by.w)) / sine) * part;
}

bool is_at_rest(const BodyMotion& motion)
{
    return motion.velocity == glm::dvec3{0.0} && motion.spin == glm::dvec3{0.0};
}

/// Where in its period something is at a time: 0..1.
double phase_at(double time, double period)
{
    const double turns = time / period;
    return turns - std::floor(turns);
}

} // namespace

void Kinematics::begin_tick(const WorldConfig& config, WorldState& state)
{
    Bodies& bodies = state.bodies;
    const double tick = config.tick;
    ticks_.resize(state.scripts.size());
    for (Slot slot = bodies.movable; slot < bodies.moving; ++slot) {
        KinematicTick& now = ticks_[slot - bodies.movable];
        KinematicScript& script = state.scripts[slot - bodies.movable];
        const glm::dvec3 from = bodies.position.at(slot);
        const glm::dquat turned = bodies.orientation.at(slot);
        now.start = {bodies.velocity.at(slot), bodies.angular_momentum.at(slot), glm::dvec3{0.0}};
        now.end = now.mean = now.start;
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
            break;
        }
        now.moves = !is_at_rest(now.start) || !is_at_rest(now.mean) || !is_at_rest(now.end);
        bodies.velocity.put(slot, now.mean.velocity);
        bodies.angular_momentum.put(slot, now.mean.spin);
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
