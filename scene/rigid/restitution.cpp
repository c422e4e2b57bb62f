// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/restitution.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hapnet::scene {

namespace {

/// A body that hits slower than this, times what gravity adds in a tick, does not bounce: it would
/// be back within that many ticks.
constexpr double bounce_threshold = 2.0;
/// A point that does not hit pushes only when something would throw it this fast, in sizes a tick.
constexpr double inactive_speed = 1e9;

struct Impact {
    double time = 0.0;  // s, from the start of the tick
    double speed = 0.0; // m/s, approaching
};

/// When a point comes down on the surface: from `from` to `to` its normal speed changes evenly.
std::optional<Impact> impact(double separation, double from, double to, double tick)
{
    if (from >= 0.0) return std::nullopt;
    if (separation <= 0.0) return Impact{0.0, -from};
    const double centripetal_velocity = (to - from) / tick;
    const double square = from * from - 2.0 * centripetal_velocity * separation;
    if (square < 0.0) return std::nullopt;
    const double time = 2.0 * separation / (-from + std::sqrt(square));
    if (time > tick) return std::nullopt;
    return Impact{time, -(from + centripetal_velocity * time)};
}

/// The first hit of the contact's points.
Impact first_impact(const ContactBlock& block, const ContactVector& from, const ContactVector& to,
                    double tick)
{
    Impact first{tick, 0.0};
    for (std::size_t i = 0; i < block.count; ++i) {
        const auto its = impact(block.separation[i], block.normal_speed(from, i),
                                block.normal_speed(to, i), tick);
        if (its && its->time <= first.time) {
            first.speed = its->time < first.time ? its->speed : std::max(first.speed, its->speed);
            first.time = its->time;
        }
    }
    return first;
}

struct BounceTarget {
    BodyIntegration& integration;
    const BodyResponse& response;
    glm::dvec3 arm;
};

/// Adds an impulse at a moment of the tick: to the velocities at once, to the mean velocities by
/// the share of the tick that is left.
void add(const BounceTarget& bounce_angular_impulse, const Wrench& push, double share_left)
{
    BodyMotion change;
    apply(push, bounce_angular_impulse.arm, bounce_angular_impulse.response, change);
    BodyIntegration& integration = bounce_angular_impulse.integration;
    integration.start_after_bounces.velocity += change.velocity;
    integration.start_after_bounces.spin += change.spin;
    integration.predicted.velocity += change.velocity;
    integration.predicted.spin += change.spin;
    integration.mean.velocity += share_left * change.velocity;
    integration.mean.spin += share_left * change.spin;
    integration.bounce_angular_impulse += change.angular_impulse;
    integration.bounce_angular_impulse_mean += share_left * change.angular_impulse;
}

/// The share of an impulse that leaves the energy at most what it was. Points that bounce by
/// themselves and friction can together ask for more (Kane, Levinson, 1985: a falling rod that
/// slides).
double share_without_energy_gain(const ContactBlock& block, const ContactVector& velocity,
                                 const ContactVector& impulse)
{
    const ContactVector change = times(block.matrix, impulse);
    double before = 0.0;
    double change_twice = 0.0;
    for (std::size_t i = 0; i < change.size(); ++i) {
        before += impulse[i] * velocity[i];
        change_twice += impulse[i] * change[i];
    }
    constexpr double rounding = 1e-12;
    if (before + 0.5 * change_twice <= rounding * std::abs(before)) return 1.0;
    return before < 0.0 ? -2.0 * before / change_twice : 0.0;
}

void apply_restitution_to(ContactBlock& block, ContactSolver& solver,
                          std::span<BodyIntegration> integrations, const Scales& scales)
{
    const ContactVector from = velocity_at(block, integrations[block.a].start_after_bounces,
                                           integrations[block.b].start_after_bounces);
    const ContactVector to =
        velocity_at(block, integrations[block.a].predicted, integrations[block.b].predicted);
    const Impact first = first_impact(block, from, to, scales.tick);
    if (first.speed <= bounce_threshold * scales.fall) return;
    const double share = first.time / scales.tick;
    ContactVector then;
    for (std::size_t i = 0; i < then.size(); ++i) then[i] = from[i] + share * (to[i] - from[i]);
    const ContactImpulse kept = block.impulse;
    const auto least = block.speed_min;
    block.impulse = {};
    constexpr double together = 1e-9; // points that hit at the same time, in shares of the size
    for (std::size_t i = 0; i < block.count; ++i) {
        const double speed = block.normal_speed(then, i);
        const double gap =
            block.separation[i] + 0.5 * first.time * (block.normal_speed(from, i) + speed);
        const bool hits = speed < 0.0 && gap <= together * scales.size;
        block.speed_min[i] =
            hits ? -block.restitution * speed : -inactive_speed * scales.size / scales.tick;
    }
    ContactVector change = solver.solve_alone(block, then, 0.0);
    const double kept_share = share_without_energy_gain(block, then, change);
    for (double& part : change) part *= kept_share;
    block.impulse = kept;
    block.speed_min = least;
    block.bounce_impulse = change[0];
    Wrench push = wrench(block, change);
    if (block.b != 0)
        add({integrations[block.b], solver.response(block.b), block.arm_b}, push, 1.0 - share);
    if (block.a == 0) return;
    push = {-push.impulse, -push.angular};
    add({integrations[block.a], solver.response(block.a), block.arm_a}, push, 1.0 - share);
}

} // namespace

void apply_restitution(ContactSolver& solver, std::span<BodyIntegration> integrations,
                       const Scales& scales)
{
    for (ContactBlock& block : solver.blocks()) {
        if (block.restitution > 0.0) apply_restitution_to(block, solver, integrations, scales);
    }
}

} // namespace hapnet::scene
