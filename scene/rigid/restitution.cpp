// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/restitution.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hapnet::scene {

namespace {

/// A body that hits slower than this, times what gravity adds in a tick, does not bounce: it would
/// be back within so many ticks.
constexpr double bounces_from = 2.0;
/// A point that does not hit pushes only when something would throw it this fast, in sizes a tick.
constexpr double out_of_play = 1e9;

struct Hit {
    double time = 0.0;  // s, from the start of the tick
    double speed = 0.0; // m/s, approaching
};

/// When a point comes down on the surface: from `from` to `to` its normal speed changes evenly.
std::optional<Hit> hit(double separation, double from, double to, double tick)
{
    if (from >= 0.0) return std::nullopt;
    if (separation <= 0.0) return Hit{0.0, -from};
    const double bend = (to - from) / tick;
    const double square = from * from - 2.0 * bend * separation;
    if (square < 0.0) return std::nullopt;
    const double time = 2.0 * separation / (-from + std::sqrt(square));
    if (time > tick) return std::nullopt;
    return Hit{time, -(from + bend * time)};
}

/// The first hit of the contact's points.
Hit first_hit(const ContactBlock& block, const Modal& from, const Modal& to, double tick)
{
    Hit first{tick, 0.0};
    for (std::size_t i = 0; i < block.count; ++i) {
        const auto its =
            hit(block.separation[i], block.normal_speed(from, i), block.normal_speed(to, i), tick);
        if (its && its->time <= first.time) {
            first.speed = its->time < first.time ? its->speed : std::max(first.speed, its->speed);
            first.time = its->time;
        }
    }
    return first;
}

struct Throw {
    BodyCourse& course;
    const BodyResponse& response;
    glm::dvec3 arm;
};

/// Adds an impulse at a moment of the tick: to the velocities at once, to the way as much as is
/// left of the tick.
void add(const Throw& thrown, const Wrench& push, double share_left)
{
    BodyMotion change;
    apply(push, thrown.arm, thrown.response, change);
    BodyCourse& course = thrown.course;
    course.rebound.velocity += change.velocity;
    course.rebound.spin += change.spin;
    course.tentative.velocity += change.velocity;
    course.tentative.spin += change.spin;
    course.mean.velocity += share_left * change.velocity;
    course.mean.spin += share_left * change.spin;
    course.thrown += change.angular_impulse;
    course.thrown_mean += share_left * change.angular_impulse;
}

/// How much of an impulse leaves the energy at most what it was. Points that bounce by themselves
/// and friction can together ask for more (Kane, Levinson, 1985: a falling rod that slides).
double share_without_gain(const ContactBlock& block, const Modal& velocity, const Modal& impulse)
{
    const Modal change = times(block.matrix, impulse);
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

void bounce_one(ContactBlock& block, ContactSolver& solver, std::span<BodyCourse> courses,
                const Scales& scales)
{
    const Modal from = velocity_at(block, courses[block.a].rebound, courses[block.b].rebound);
    const Modal to = velocity_at(block, courses[block.a].tentative, courses[block.b].tentative);
    const Hit first = first_hit(block, from, to, scales.tick);
    if (first.speed <= bounces_from * scales.fall) return;
    const double share = first.time / scales.tick;
    Modal then;
    for (std::size_t i = 0; i < then.size(); ++i) then[i] = from[i] + share * (to[i] - from[i]);
    const ContactImpulse kept = block.impulse;
    const auto least = block.least;
    block.impulse = {};
    constexpr double together = 1e-9; // points that hit at the same time, in shares of the size
    for (std::size_t i = 0; i < block.count; ++i) {
        const double speed = block.normal_speed(then, i);
        const double gap =
            block.separation[i] + 0.5 * first.time * (block.normal_speed(from, i) + speed);
        const bool hits = speed < 0.0 && gap <= together * scales.size;
        block.least[i] =
            hits ? -block.restitution * speed : -out_of_play * scales.size / scales.tick;
    }
    Modal change = solver.solve_one(block, then, 0.0);
    const double kept_share = share_without_gain(block, then, change);
    for (double& part : change) part *= kept_share;
    block.impulse = kept;
    block.least = least;
    Wrench push = wrench(block, change);
    if (block.b != 0)
        add({courses[block.b], solver.response(block.b), block.arm_b}, push, 1.0 - share);
    if (block.a == 0) return;
    push = {-push.impulse, -push.angular};
    add({courses[block.a], solver.response(block.a), block.arm_a}, push, 1.0 - share);
}

} // namespace

void bounce(ContactSolver& solver, std::span<BodyCourse> courses, const Scales& scales)
{
    for (ContactBlock& block : solver.blocks()) {
        if (block.restitution > 0.0) bounce_one(block, solver, courses, scales);
    }
}

} // namespace hapnet::scene
