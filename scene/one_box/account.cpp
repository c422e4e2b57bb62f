// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/one_box/account.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace hapnet::scene {

namespace {

/// What a spring stores at a depth, while it gives no more than its greatest force.
double stored_at(const HandDescription& hands, double depth)
{
    const double bend = hands.force_max_n / hands.stiffness_n_per_m;
    if (depth <= 0.0) return 0.0;
    return depth < bend ? 0.5 * hands.stiffness_n_per_m * depth * depth
                        : hands.force_max_n * (depth - 0.5 * bend);
}

/// What the hands have given.
struct Given {
    double stored = 0.0; // J
    double work = 0.0;   // J, of their motion
    double excess = 1.0; // the greatest impulse, as a multiple of what a hand may give
    bool any = false;
};

Given given_by_hands(const WorldConfig& config, const WorldState& state, double held)
{
    Given given{.stored = held};
    for (std::uint32_t i = 0; i < config.hands.count; ++i) {
        const HandTouch& touch = state.touches[i];
        if (!touch.touching) continue;
        given.any = true;
        const glm::dvec3 impulse = config.tick * touch.on_body.value;
        given.work += glm::dot(impulse, state.hands[i].velocity.value);
        if (!touch.holding) given.stored += stored_at(config.hands, touch.depth_m);
        const double most = config.tick * config.hands.force_max_n;
        const double size = length(impulse);
        if (size > given.excess * most) given.excess = size / most;
    }
    return given;
}

/// Whether the box is at a face and moves into it.
bool enters_obstacle(const BoxMotion& box, std::size_t axis)
{
    const AxisMotion& motion = box.axes[axis];
    return (motion.below && box.velocity[axis] < 0.0) || (motion.above && box.velocity[axis] > 0.0);
}

} // namespace

void settle(const WorldConfig& config, WorldState& state, const TickStart& start, BoxMotion& box)
{
    constexpr double rounding = 1e-9;
    constexpr double tolerated = 1e-7; // of the energy that is there
    const double mass = 1.0 / box.oscillators.inverse_mass();
    const double tick = config.tick;
    const Given given = given_by_hands(config, state, start.stored);
    PerAxis free = start.velocity; // at the end, without impulses
    PerAxis gained = box.velocity; // by impulses
    PerAxis moved = box.position;
    PerAxis steady{};
    for (std::size_t i = 0; i < 3; ++i) {
        free[i] += tick * start.steady[i];
        gained[i] -= free[i];
        moved[i] -= start.position[i];
        steady[i] = 0.5 * tick * (start.velocity[i] + box.velocity[i]);
    }
    const double before = 0.5 * mass * dot(start.velocity, start.velocity);
    const double after = 0.5 * mass * dot(box.velocity, box.velocity);
    const double work = mass * std::max(dot(start.steady, moved), dot(start.steady, steady));
    const double gain = after - before - work - given.stored - given.work;
    double share = 1.0;
    if (gain > tolerated * (before + after + std::abs(work))) {
        // gain = a share^2 + b share - stored, with the work at the mean velocity
        const double a = 0.5 * mass * dot(gained, gained);
        const double b =
            mass * (dot(free, gained) - 0.5 * tick * dot(start.steady, gained)) - given.work;
        const double root = std::sqrt(b * b + 4.0 * a * given.stored);
        share = b > 0.0 ? 2.0 * given.stored / (b + root) : (root - b) / (2.0 * a);
    }
    if (given.excess > 1.0 + rounding) share = std::min(share, 1.0 / given.excess);
    if (share >= 1.0) return;
    ++(given.any ? state.interventions.hands_braked : state.interventions.islands_limited);
    for (std::size_t i = 0; i < 3; ++i) {
        box.velocity[i] = free[i] + share * gained[i];
        if (enters_obstacle(box, i)) box.velocity[i] = 0.0;
    }
    for (std::uint32_t i = 0; i < config.hands.count; ++i) {
        HandTouch& touch = state.touches[i];
        touch.on_hand.value += (1.0 - share) * touch.on_body.value;
        touch.on_body.value *= share;
    }
}

} // namespace hapnet::scene
