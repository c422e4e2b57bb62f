// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/touch.hpp"

#include "scene/solver/block_solver.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace hapnet::scene {

namespace {

/// An impulse, and its effect.
struct Answer {
    ContactVector impulse{};
    double share = 1.0; // share of the impulse that gains no energy
    bool parts = false; // true if no point approaches any more
};

Answer answer_of(ContactBlock& block, const ContactVector& before)
{
    block.impulse = {};
    Answer answer{.impulse = solve(block, before, 0.0)};
    ContactVector after = times(block.matrix, answer.impulse);
    for (std::size_t i = 0; i < after.size(); ++i) after[i] += before[i];
    answer.share = energy_of(block, answer.impulse, before).share_within(0.0);
    double slowest = 0.0;
    double fastest = 0.0; // greatest speed of approach before the impulse
    for (std::size_t i = 0; i < block.count; ++i) {
        slowest = std::min(slowest, block.normal_speed(after, i));
        fastest = std::max(fastest, -block.normal_speed(before, i));
    }
    constexpr double rounding = 1e-9;
    answer.parts = slowest >= -rounding * fastest;
    return answer;
}

} // namespace

ContactVector touch_impulse(ContactBlock& block, const Toucher& a, const Toucher& b,
                            double bounces_from)
{
    const ContactVector before = velocity_at(block, a.motion, b.motion);
    bool any = false;
    for (std::size_t i = 0; i < block.count; ++i) {
        const double speed = block.normal_speed(before, i);
        any = any || speed < 0.0;
        block.speed_min[i] = -speed > bounces_from ? -block.restitution * speed : 0.0;
    }
    if (!any) return {};
    build_matrix(block, a.response, b.response);
    Answer answer = answer_of(block, before);
    // A bounce with friction may require more energy than there is (Kane and Levinson, 1985), and a
    // slip may have no solution. Then the touch is computed without friction, which always has a
    // solution.
    if (block.friction != 0.0 && !(answer.parts && answer.share == 1.0)) {
        block.friction = 0.0;
        answer = answer_of(block, before);
    }
    for (double& part : answer.impulse) part *= answer.share;
    return answer.impulse;
}

void apply_impulse(Bodies& bodies, Slot slot, const Wrench& push, const glm::dvec3& arm)
{
    const BodyProperties& properties = bodies.properties[slot];
    bodies.velocity.put(slot, bodies.velocity.at(slot) + properties.inverse_mass * push.impulse);
    bodies.angular_momentum.put(
        slot, bodies.angular_momentum.at(slot) +
                  about_unlocked_axes(properties, glm::cross(arm, push.impulse) + push.angular));
}

} // namespace hapnet::scene
