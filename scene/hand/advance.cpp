// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/hand/advance.hpp"

#include "proto/base/ensure.hpp"
#include "scene/hand/midpoint.hpp"
#include "scene/hand/passage.hpp"
#include "scene/hand/steady.hpp"
#include "scene/maths/vector.hpp"

#include <array>
#include <cmath>

namespace hapnet::scene {

namespace {

/// How far the body and the hands may come towards each other in the tick: what they do already,
/// twice, and what is stored in the springs that are pressed.
double reach(const MovingBody& body, const Answer& answer, std::span<const HandSpring> springs,
             double tick)
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
        length(answer.inverse_inertia * (body.angular_momentum + tick * answer.torque));
    return 2.0 * (tick * (speed + turning * arm + tick * length(answer.acceleration)) + stored);
}

/// Whether the springs that may act in the tick are few and have a closed form; they are picked.
struct Picked {
    std::array<std::size_t, 2> which{};
    std::size_t count = 0;
    bool is_closed = true;
};
Picked pick(const MovingBody& body, const Answer& answer, std::span<const HandSpring> springs,
            double tick)
{
    bool is_near = false;
    for (const HandSpring& spring : springs) is_near = is_near || spring.gap > 0.0;
    const double within = is_near ? reach(body, answer, springs, tick) : 0.0;
    Picked picked;
    for (std::size_t i = 0; i < springs.size(); ++i) {
        const HandSpring& spring = springs[i];
        const bool is_idle = spring.stiffness <= 0.0 && spring.damping <= 0.0;
        if (is_idle || (!spring.holds && spring.gap > within)) continue;
        if (spring.holds || picked.count == 2) {
            picked.is_closed = false;
            return picked;
        }
        picked.which[picked.count++] = i;
    }
    return picked;
}

struct Task {
    MovingBody& body;
    const Answer& answer;
    std::span<const HandSpring> springs;
    std::span<SpringImpulse> work;
};
template <std::size_t count>
void pass(const Task& task, const Picked& picked, double tick)
{
    Passage<count> passage{task.body, task.answer, tick};
    for (std::size_t i = 0; i < count; ++i)
        passage.set(i, task.springs[picked.which[i]], task.work[picked.which[i]]);
    if (passage.pass()) return;

    const auto now = passage.current();
    std::array<SpringImpulse, count> rest;
    Answer rotated = task.answer;
    rotated.inverse_inertia = passage.inverse_inertia();
    Midpoint{task.body, rotated, now, rest}.pass(passage.left());
    for (std::size_t i = 0; i < count; ++i) task.work[picked.which[i]].impulse += rest[i].impulse;
}

} // namespace

void advance(MovingBody& body, const Answer& answer, std::span<const HandSpring> springs,
             std::span<SpringImpulse> work, double tick)
{
    base::ensure(work.size() >= springs.size());
    if (springs.empty()) {
        advance_freely(body, answer, tick);
        return;
    }
    if (press_steadily(body, answer, springs, work, tick)) return;
    for (SpringImpulse& each : work) each = {};
    const Picked picked = pick(body, answer, springs, tick);
    if (!picked.is_closed) {
        Midpoint{body, answer, springs, work}.pass(tick);
        return;
    }
    if (picked.count == 0) {
        advance_freely(body, answer, tick);
        return;
    }
    if (picked.count == 1) {
        pass<1>({body, answer, springs, work}, picked, tick);
    } else {
        pass<2>({body, answer, springs, work}, picked, tick);
    }
}

} // namespace hapnet::scene
