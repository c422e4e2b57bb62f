// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/hand/advance.hpp"

#include "proto/base/ensure.hpp"
#include "scene/hand/constant_contact.hpp"
#include "scene/hand/contact_phases.hpp"
#include "scene/hand/midpoint.hpp"
#include "scene/hand/passivity.hpp"
#include "scene/maths/vector.hpp"

#include <array>
#include <cmath>

namespace hapnet::scene {

namespace {

/// Returns how far the body and the hands may approach each other in the tick, m. It is twice the
/// sum of the distance of their present motion and of the depths to which springs are pressed.
double reach(const MovingBody& body, const BodyDynamics& dynamics,
             std::span<const HandSpring> springs, double tick)
{
    double speed = 0.0;
    double stored = 0.0;
    double arm = 0.0;
    for (const HandSpring& spring : springs) {
        speed += length(body.velocity - spring.velocity);
        if (spring.gap < 0.0) stored -= spring.gap;
        arm = std::max(arm, length(spring.arm));
    }
    const double turning =
        length(dynamics.inverse_inertia * (body.angular_momentum + tick * dynamics.torque));
    return 2.0 * (tick * (speed + turning * arm + tick * length(dynamics.acceleration)) + stored);
}

/// The springs that may act in the tick. `is_closed` is true if they are few and have a closed
/// form; `which` and `count` are complete only then.
struct Chosen {
    std::array<std::size_t, 2> which{};
    std::size_t count = 0;
    bool is_closed = true;
};
Chosen choose(const MovingBody& body, const BodyDynamics& dynamics,
              std::span<const HandSpring> springs, double tick)
{
    bool is_near = false;
    for (const HandSpring& spring : springs) is_near = is_near || spring.gap > 0.0;
    const double within = is_near ? reach(body, dynamics, springs, tick) : 0.0;
    Chosen chosen;
    for (std::size_t i = 0; i < springs.size(); ++i) {
        const HandSpring& spring = springs[i];
        const bool is_idle = spring.stiffness <= 0.0 && spring.damping <= 0.0;
        if (is_idle || (!spring.holds && spring.gap > within)) continue;
        if (spring.holds || chosen.count == 2) {
            chosen.is_closed = false;
            return chosen;
        }
        chosen.which[chosen.count++] = i;
    }
    return chosen;
}

struct Task {
    MovingBody& body;
    const BodyDynamics& dynamics;
    std::span<const HandSpring> springs;
    std::span<SpringImpulse> work;
    PressedModes& modes;
    std::size_t& rows; // rows that the midpoint rule solved
};
template <std::size_t count>
void advance_by_phases(const Task& task, const Chosen& chosen, double tick)
{
    ContactPhases<count> phases{task.body, task.dynamics, tick};
    for (std::size_t i = 0; i < count; ++i)
        phases.set(i, task.springs[chosen.which[i]], task.work[chosen.which[i]]);
    if (phases.advance()) return;

    const auto now = phases.current();
    std::array<SpringImpulse, count> rest;
    BodyDynamics rotated = task.dynamics;
    rotated.inverse_inertia = phases.inverse_inertia();
    task.rows += MidpointRule{task.body, rotated, now, rest}.advance(phases.time_left());
    for (std::size_t i = 0; i < count; ++i) task.work[chosen.which[i]].impulse += rest[i].impulse;
}

/// True if the body has turned so little that the directions of springs are unchanged up to
/// rounding.
bool has_hardly_turned(const MovingBody& start, const MovingBody& end)
{
    constexpr double hardly = 5e-11; // half of the angle, rad
    const glm::dquat& from = start.orientation;
    const glm::dquat& to = end.orientation;
    return std::abs(to.x - from.x) + std::abs(to.y - from.y) + std::abs(to.z - from.z) <= hardly;
}

/// As energy_of(), for springs that all press, none of them with its greatest force.
HandEnergy energy_of_pressed(std::span<const HandSpring> springs,
                             std::span<const SpringImpulse> work)
{
    HandEnergy energy;
    for (std::size_t i = 0; i < springs.size(); ++i) {
        const HandSpring& spring = springs[i];
        energy.stored += 0.5 * spring.stiffness * spring.gap * spring.gap;
        energy.driven += glm::dot(work[i].impulse, spring.velocity);
    }
    return energy;
}

/// True if the springs hardly change the body's velocity within a tick. Then drag may count as a
/// constant force.
bool are_soft(const BodyDynamics& dynamics, std::span<const HandSpring> springs, double tick)
{
    const glm::dvec3& light = dynamics.inverse_mass;
    const glm::dmat3& turn = dynamics.inverse_inertia;
    double most = 0.0;
    for (const HandSpring& spring : springs) {
        const double own = std::max(light.x, std::max(light.y, light.z)) +
                           (turn[0].x + turn[1].y + turn[2].z) * glm::dot(spring.arm, spring.arm);
        most += own * tick * (spring.stiffness * tick + spring.damping);
    }
    constexpr double soft = 0.5;
    return most <= soft && dynamics.drag * tick < soft;
}

/// Advances through all beginnings and ends of contacts, without drag.
void advance_by_events(const Task& task, double tick)
{
    for (SpringImpulse& each : task.work) each = {};
    const Chosen chosen = choose(task.body, task.dynamics, task.springs, tick);
    if (!chosen.is_closed) {
        task.rows += MidpointRule{task.body, task.dynamics, task.springs, task.work}.advance(tick);
    } else if (chosen.count == 0) {
        advance_freely(task.body, task.dynamics, tick);
    } else if (chosen.count == 1) {
        advance_by_phases<1>(task, chosen, tick);
    } else {
        advance_by_phases<2>(task, chosen, tick);
    }
}

glm::dvec3 along_plane(const BodyDynamics& dynamics, const glm::dvec3& v)
{
    const glm::dvec3 along = v - glm::dot(v, dynamics.drag_normal) * dynamics.drag_normal;
    const glm::dvec3& light = dynamics.inverse_mass;
    return {light.x > 0.0 ? along.x : 0.0, light.y > 0.0 ? along.y : 0.0,
            light.z > 0.0 ? along.z : 0.0};
}

void advance_with_drag(const Task& task, double tick)
{
    const auto& [body, dynamics, springs, work, modes, rows] = task;
    if (!are_soft(dynamics, springs, tick)) {
        for (SpringImpulse& each : work) each = {};
        rows += MidpointRule{body, dynamics, springs, work}.advance(tick);
        return;
    }
    // Drag counts as a constant force that follows from the mean velocity. That takes two passes.
    BodyDynamics held = dynamics;
    held.drag = 0.0;
    const MovingBody start = body;
    glm::dvec3 mean = start.velocity;
    for (int pass = 0; pass < 2; ++pass) {
        body = start;
        held.acceleration = dynamics.acceleration - dynamics.drag * along_plane(dynamics, mean);
        if (!advance_in_constant_contact(body, held, springs, work, tick, modes))
            advance_by_events({body, held, springs, work, modes, rows}, tick);
        mean = 0.5 * (start.velocity + body.velocity);
    }
}

/// Does the part of advance() that most ticks do not need.
HandEnergy advance_otherwise(const Task& task, const MovingBody& start, bool is_done, double tick)
{
    const auto& [body, dynamics, springs, work, modes, rows] = task;
    const HandTick outcome{start, body, dynamics, tick};
    if (is_done) return keep_passive(outcome, springs, work, SpringsAtEnd::ignored);
    if (springs.empty()) {
        advance_freely(body, dynamics, tick);
        return {};
    }
    if (dynamics.drag > 0.0) {
        advance_with_drag(task, tick);
    } else {
        advance_by_events(task, tick);
    }
    HandEnergy energy = keep_passive(outcome, springs, work, SpringsAtEnd::counted);
    energy.rows = rows;
    return energy;
}

} // namespace

HandEnergy advance(MovingBody& body, const BodyDynamics& dynamics,
                   std::span<const HandSpring> springs, std::span<SpringImpulse> work, double tick,
                   PressedModes& modes)
{
    base::ensure(work.size() >= springs.size());
    const MovingBody start = body;
    const bool is_done = dynamics.drag == 0.0 &&
                         advance_in_constant_contact(body, dynamics, springs, work, tick, modes);
    if (is_done && has_hardly_turned(start, body)) return energy_of_pressed(springs, work); // exact
    std::size_t rows = 0;
    const HandEnergy energy = advance_otherwise(
        {body, dynamics, springs, work.first(springs.size()), modes, rows}, start, is_done, tick);
    // Stiff hands leave the velocity that follows from their impulses, to the last digit of such
    // large numbers: the impulses may cancel each other, or bring the body to rest.
    const bool is_stiff = springs.size() > 1 || !are_soft(dynamics, springs, tick);
    if (is_stiff && dynamics.drag == 0.0) {
        glm::dvec3 impulse{0.0};
        for (std::size_t i = 0; i < springs.size(); ++i) impulse += work[i].impulse;
        body.velocity =
            start.velocity + tick * dynamics.acceleration + dynamics.inverse_mass * impulse;
    }
    return energy;
}

} // namespace hapnet::scene
