// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/restitution.hpp"

#include "scene/rigid/driven_energy.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hapnet::scene {

namespace {

/// A body that hits more slowly than this, times the speed that gravity adds in a tick, does not
/// bounce: it would be back within that many ticks.
constexpr double bounce_threshold = 2.0;
/// A point that does not hit pushes only if something would otherwise throw it this fast, in sizes
/// per tick.
constexpr double inactive_speed = 1e9;

struct Impact {
    double time = 0.0;  // s, from the start of the tick
    double speed = 0.0; // m/s: speed of approach
};

/// The motion of a contact's two bodies towards each other while none of its points hits.
struct Approach {
    ContactVector from;   // at the start of the tick, as if the last bounces came before it
    ContactVector to;     // at the end of the tick
    ContactVector offset; // m, rad: shift of the start that makes up for the time of those bounces
    double begin = 0.0;   // s: time of the last of these bounces

    /// Returns the gap of a point at the start of the tick, on that path.
    [[nodiscard]] double separation(const ContactBlock& block, std::size_t point) const
    {
        return block.separation[point] + block.normal_speed(offset, point);
    }
};

/// Returns when a point reaches the surface. Its normal speed changes linearly from `from` to `to`.
std::optional<Impact> impact(double separation, double from, double to, double time_left)
{
    if (from >= 0.0) return std::nullopt;
    if (separation <= 0.0) return Impact{0.0, -from};
    const double acceleration = (to - from) / time_left;
    const double square = from * from - 2.0 * acceleration * separation;
    if (square < 0.0) return std::nullopt;
    const double time = 2.0 * separation / (-from + std::sqrt(square));
    if (time > time_left) return std::nullopt;
    return Impact{time, -(from + acceleration * time)};
}

/// Returns the first hit of the contact's points.
Impact first_impact(const ContactBlock& block, const Approach& approach, double tick)
{
    const double begin = approach.begin;
    Impact first{tick, 0.0};
    if (begin >= tick) return first;
    for (std::size_t i = 0; i < block.count; ++i) {
        double gap = approach.separation(block, i);
        double from = block.normal_speed(approach.from, i);
        const double to = block.normal_speed(approach.to, i);
        if (begin > 0.0) {
            const double then = from + begin / tick * (to - from);
            gap += 0.5 * begin * (from + then);
            from = then;
        }
        const auto its = impact(gap, from, to, tick - begin);
        if (!its || begin + its->time > first.time) continue;
        const double time = begin + its->time;
        first.speed = time < first.time ? its->speed : std::max(first.speed, its->speed);
        first.time = time;
    }
    return first;
}

struct BounceTarget {
    BodyIntegration& integration;
    const BodyResponse& response;
    glm::dvec3 arm;
};

/// The kinematic body from which a body bounces.
struct BounceSurface {
    const BodyIntegration& integration;
    glm::dvec3 arm;
};

/// Adds an impulse at a moment of the tick: to the velocities at once, to the mean velocities by
/// the share of the tick that is left, and less of both against drag.
void add(const BounceTarget& target, const Wrench& push, double time, double tick)
{
    BodyMotion change;
    apply(push, target.arm, target.response, change);
    BodyIntegration& integration = target.integration;
    const double share_left = 1.0 - time / tick;
    integration.start_after_bounces.velocity += change.velocity;
    integration.start_after_bounces.spin += change.spin;
    integration.bounce_offset.velocity -= time * change.velocity;
    integration.bounce_offset.spin -= time * change.spin;
    integration.last_bounce = time;
    const VelocityChange later =
        change_within(integration, target.response, change.velocity, share_left, tick);
    integration.predicted.velocity += later.at_end;
    integration.predicted.spin += change.spin;
    integration.mean.velocity += later.mean;
    integration.mean.spin += share_left * change.spin;
    integration.bounce_angular_impulse += change.angular_impulse;
    integration.bounce_angular_impulse_mean += share_left * change.angular_impulse;
}

/// Returns a body's motion after a share of the tick. `from` is the motion at its start.
BodyMotion motion_at(double share, const BodyMotion& from, const BodyMotion& to)
{
    return {from.velocity + share * (to.velocity - from.velocity),
            from.spin + share * (to.spin - from.spin), glm::dvec3{0.0}};
}

/// Adds the energy that a kinematic body gives by a bounce. Call it before add(), while the body's
/// motion still lacks the bounce.
void add_driven(const BounceTarget& target, const BounceSurface& surface, const Wrench& push,
                double share)
{
    if (is_nothing(push)) return;
    BodyIntegration& integration = target.integration;
    BodyMotion motion = motion_at(share, integration.start_after_bounces, integration.predicted);
    double taken = 0.5 * work_of(push, target.arm, motion);
    apply(push, target.arm, target.response, motion);
    taken += 0.5 * work_of(push, target.arm, motion);
    const BodyMotion thrower =
        motion_at(share, surface.integration.start, surface.integration.predicted);
    integration.driven.add({driven_energy(work_of(push, surface.arm, thrower), taken),
                            length(velocity_at(thrower, surface.arm))});
}

/// Returns the share of an impulse that adds no energy. Points that bounce separately and friction
/// together can demand more energy than there is (Kane, Levinson, 1985: a falling rod that slides).
double share_without_energy_gain(const ContactBlock& block, const ContactVector& velocity,
                                 const ContactVector& impulse)
{
    const EnergyOfShare energy = energy_of(block, impulse, velocity);
    constexpr double rounding = 1e-12;
    return energy.share_within(rounding * std::abs(energy.linear));
}

Approach approach_of(const ContactBlock& block, std::span<const BodyIntegration> integrations)
{
    const BodyIntegration& a = integrations[block.a];
    const BodyIntegration& b = integrations[block.b];
    return {velocity_at(block, a.start_after_bounces, b.start_after_bounces),
            velocity_at(block, a.predicted, b.predicted),
            velocity_at(block, a.bounce_offset, b.bounce_offset),
            std::max(a.last_bounce, b.last_bounce)};
}

/// True if forces act on the body that would differ after a bounce: those of hands or other
/// contacts. They count as constant over the tick, so a bounce may gain energy relative to any of
/// the body's velocities.
bool is_driven(const BodyIntegration& body)
{
    return body.has_hands || body.contact_impulse != glm::dvec3{0.0} ||
           body.contact_angular_impulse != glm::dvec3{0.0};
}

bool any_bounces(const WorldConfig& config, const Bodies& bodies)
{
    const auto bounces = [](const auto& part) { return part.material.restitution > 0.0; };
    return std::any_of(bodies.properties.begin(), bodies.properties.end(), bounces) ||
           std::any_of(config.planes.begin(), config.planes.end(), bounces);
}

} // namespace

Restitution::Restitution(const WorldConfig& config, const Bodies& bodies, std::size_t blocks,
                         const Scales& scales)
    : scales_{scales},
      is_needed_{any_bounces(config, bodies)},
      bouncing_{is_needed_ ? blocks : 0},
      next_{is_needed_ ? 2 * blocks : 0},
      heads_{is_needed_ ? bodies.moving + std::size_t{1} : 0}
{}

/// Lists the contacts that bounce, and the contacts of each body.
void Restitution::begin(ContactSolver& solver, std::span<const BodyIntegration> integrations,
                        std::span<const std::uint8_t> picked)
{
    const std::span<ContactBlock> blocks = solver.blocks();
    bouncing_.clear();
    next_.clear();
    heads_.resize(integrations.size());
    for (std::uint32_t& head : heads_.all()) head = none;
    for (std::uint32_t i = 0; i < blocks.size(); ++i) {
        if (!(blocks[i].restitution > 0.0)) continue;
        if (!picked.empty() && picked[solver.responding_of(blocks[i])] == 0) continue;
        const auto place = static_cast<std::uint32_t>(bouncing_.size());
        bouncing_.add() = {.block = i};
        for (const SolverIndex body : {blocks[i].a, blocks[i].b}) {
            const auto link = static_cast<std::uint32_t>(next_.size());
            next_.add() = heads_[body];
            if (solver.responds(body)) heads_[body] = link;
        }
        look(bouncing_[place], blocks[i], integrations);
    }
}

/// Finds when a contact hits next.
void Restitution::look(Bouncing& contact, const ContactBlock& block,
                       std::span<const BodyIntegration> integrations) const
{
    contact.time = never;
    if (contact.bounces == bounces_max) return;
    const Impact first = first_impact(block, approach_of(block, integrations), scales_.tick);
    if (first.speed > bounce_threshold * scales_.fall) contact.time = first.time;
}

bool Restitution::apply(ContactSolver& solver, std::span<BodyIntegration> integrations,
                        Interventions& interventions, std::span<const std::uint8_t> picked)
{
    if (!is_needed_) return false;
    begin(solver, integrations, picked);
    const std::span<ContactBlock> blocks = solver.blocks();
    const std::span<Bouncing> all = bouncing_.all();
    const auto is_earlier = [](const Bouncing& one, const Bouncing& other) {
        return one.time < other.time;
    };
    bool any = false;
    for (;;) {
        const auto next = std::min_element(all.begin(), all.end(), is_earlier);
        if (next == all.end() || next->time == never) return any;
        any = true;
        ++next->bounces;
        ContactBlock& block = blocks[next->block];
        if (bounce(block, solver, integrations, scales_) < 1.0) ++interventions.bounces_limited;
        for (const SolverIndex body : {block.a, block.b}) {
            if (!solver.responds(body)) continue;
            for (std::uint32_t link = heads_[body]; link != none; link = next_[link]) {
                Bouncing& other = all[link / 2];
                look(other, blocks[other.block], integrations);
            }
        }
    }
}

void Restitution::leave_coming(ContactBlock& block,
                               std::span<const BodyIntegration> integrations) const
{
    if (!is_needed_ || !(block.restitution > 0.0)) return;
    const BodyIntegration& a = integrations[block.a];
    const BodyIntegration& b = integrations[block.b];
    const ContactVector end = velocity_at(block, a.predicted, b.predicted);
    const ContactVector mean = velocity_at(block, a.mean, b.mean);
    for (std::size_t i = 0; i < block.count; ++i) {
        const double speed = block.normal_speed(end, i);
        const double gap = block.separation[i] + scales_.tick * block.normal_speed(mean, i);
        if (speed >= -bounce_threshold * scales_.fall || gap < 0.0) continue;
        const double turning =
            block.turns ? block.normal_speed(block.centripetal_velocity, i) : 0.0;
        block.speed_min[i] = std::min(block.speed_min[i], speed + std::min(turning, 0.0));
    }
}

/// Makes the contact bounce, if the earlier bounces have left a bounce for it.
double Restitution::bounce(ContactBlock& block, ContactSolver& solver,
                           std::span<BodyIntegration> integrations, const Scales& scales)
{
    const Approach approach = approach_of(block, integrations);
    const Impact first = first_impact(block, approach, scales.tick);
    if (first.speed <= bounce_threshold * scales.fall) return 1.0;
    const double share = first.time / scales.tick;
    const ContactVector& from = approach.from;
    ContactVector then;
    for (std::size_t i = 0; i < then.size(); ++i)
        then[i] = from[i] + share * (approach.to[i] - from[i]);
    const ContactImpulse kept = block.impulse;
    const auto least = block.speed_min;
    block.impulse = {};
    constexpr double together = 1e-9; // points that hit at the same time, in shares of the size
    for (std::size_t i = 0; i < block.count; ++i) {
        const double speed = block.normal_speed(then, i);
        const double gap = approach.separation(block, i) +
                           0.5 * first.time * (block.normal_speed(from, i) + speed);
        const bool hits = speed < 0.0 && gap <= together * block.size;
        block.speed_min[i] =
            hits ? -block.restitution * speed : -inactive_speed * block.size / scales.tick;
    }
    ContactVector change = solver.solve_alone(block, then, 0.0);
    double kept_share = share_without_energy_gain(block, then, change);
    if (is_driven(integrations[block.a]) || is_driven(integrations[block.b])) {
        kept_share = std::min(kept_share, share_without_energy_gain(block, approach.to, change));
    }
    for (double& part : change) part *= kept_share;
    block.impulse = kept;
    block.speed_min = least;
    block.bounce_impulse += change[0];
    const Wrench on_b = wrench(block, change);
    const Wrench on_a{-on_b.impulse, -on_b.angular};
    if (solver.responds(block.b)) {
        const BounceTarget b{integrations[block.b], solver.response(block.b), block.arm_b};
        if (solver.is_kinematic(block.a))
            add_driven(b, {integrations[block.a], block.arm_a}, on_b, share);
        add(b, on_b, first.time, scales.tick);
    }
    if (solver.responds(block.a)) {
        const BounceTarget a{integrations[block.a], solver.response(block.a), block.arm_a};
        if (solver.is_kinematic(block.b))
            add_driven(a, {integrations[block.b], block.arm_b}, on_a, share);
        add(a, on_a, first.time, scales.tick);
    }
    return kept_share;
}

} // namespace hapnet::scene
