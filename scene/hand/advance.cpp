// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/hand/advance.hpp"

#include "proto/base/ensure.hpp"
#include "scene/hand/constant_contact.hpp"
#include "scene/hand/contact_phases.hpp"
#include "scene/hand/midpoint.hpp"
#include "scene/maths/vector.hpp"

#include <array>
#include <cmath>

namespace hapnet::scene {

namespace {

/// How far the body and the hands may come towards each other in the tick: what they do already,
/// twice, and what is stored in the springs that are pressed.
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

/// Whether the springs that may act in the tick are few and have a closed form; they are picked.
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
    MidpointRule{task.body, rotated, now, rest}.advance(phases.time_left());
    for (std::size_t i = 0; i < count; ++i) task.work[chosen.which[i]].impulse += rest[i].impulse;
}

} // namespace

void advance(MovingBody& body, const BodyDynamics& dynamics, std::span<const HandSpring> springs,
             std::span<SpringImpulse> work, double tick, PressedModes& modes)
{
    base::ensure(work.size() >= springs.size());
    if (springs.empty()) {
        advance_freely(body, dynamics, tick);
        return;
    }
    if (advance_in_constant_contact(body, dynamics, springs, work, tick, modes)) return;
    for (SpringImpulse& each : work) each = {};
    const Chosen chosen = choose(body, dynamics, springs, tick);
    if (!chosen.is_closed) {
        MidpointRule{body, dynamics, springs, work}.advance(tick);
        return;
    }
    if (chosen.count == 0) {
        advance_freely(body, dynamics, tick);
        return;
    }
    if (chosen.count == 1) {
        advance_by_phases<1>({body, dynamics, springs, work}, chosen, tick);
    } else {
        advance_by_phases<2>({body, dynamics, springs, work}, chosen, tick);
    }
}

} // namespace hapnet::scene
