// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/scene/tick/courses.hpp"

#include "peer/core/scene/motion/rotation.hpp"
#include "peer/core/scene/tick/flight.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace hapnet::scene {

namespace {

/// An angular impulse changes the momentum only about axes that the body may turn about.
glm::dvec3 about_free_axes(const BodyForm& form, const glm::dvec3& angular)
{
    if (form.turning == Turning::free) return angular;
    return {form.inverse_inertia.x > 0.0 ? angular.x : 0.0,
            form.inverse_inertia.y > 0.0 ? angular.y : 0.0,
            form.inverse_inertia.z > 0.0 ? angular.z : 0.0};
}

/// A turn too small to show in an orientation.
bool is_nothing(const glm::dvec3& angle)
{
    constexpr double nothing = 1e-18;
    return std::abs(angle.x) < nothing && std::abs(angle.y) < nothing &&
           std::abs(angle.z) < nothing;
}

void turn(const BodyCourse& course, Bodies& bodies, Slot slot, const BodyMotion& mean, double tick)
{
    const BodyForm& form = bodies.form[slot];
    const glm::dquat now = bodies.orientation.at(slot);
    if (is_nothing(tick * mean.spin)) return;
    if (turns_evenly(form)) {
        bodies.orientation.put(slot, turned(now, tick * mean.spin));
        return;
    }
    const glm::dvec3 momentum =
        bodies.angular_momentum.at(slot) + 0.5 * course.angular_impulse + mean.angular_impulse;
    bodies.orientation.put(slot, spun(now, {momentum, form.inverse_inertia}, tick));
}

} // namespace

Scales scales_of(const Frozen& frozen, const Bodies& bodies)
{
    double size = std::numeric_limits<double>::infinity();
    for (Slot slot = 0; slot < bodies.movable; ++slot) {
        const glm::dvec3& half = bodies.form[slot].half;
        size = std::min(size, std::min(half.x, std::min(half.y, half.z)));
    }
    constexpr double hardly = 1e-6;
    const double fall = frozen.tick * std::sqrt(glm::dot(frozen.gravity, frozen.gravity));
    return {frozen.tick, size, fall, std::max(fall, hardly * size / frozen.tick)};
}

OrientedBox box_of(const Bodies& bodies, Slot slot)
{
    return {bodies.position.at(slot), axes_of(bodies.orientation.at(slot)), bodies.form[slot].half};
}

BodyResponse response_of(const BodyForm& form, const OrientedBox& box)
{
    const glm::dvec3& about = form.inverse_inertia;
    BodyResponse response{form.inverse_mass, glm::dmat3{0.0}};
    if (turns_evenly(form)) {
        for (int i = 0; i < 3; ++i) response.inverse_inertia[i][i] = about[i];
        return response;
    }
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            double sum = 0.0;
            for (int own = 0; own < 3; ++own) {
                sum += box.axes[own][row] * about[own] * box.axes[own][column];
            }
            response.inverse_inertia[column][row] = sum;
        }
    }
    return response;
}

void follow(BodyCourse& course, const Stage& stage, Slot slot, const BodyResponse& response,
            const Frozen& frozen)
{
    const Bodies& bodies = stage.bodies;
    const BodyForm& form = bodies.form[slot];
    const double tick = frozen.tick;
    course.angular_impulse = about_free_axes(form, course.angular_impulse);
    const glm::dvec3 gained = tick * falling(form, frozen.gravity) +
                              form.inverse_mass * (course.impulse + tick * stage.pushes[form.id]);
    const glm::dvec3 momentum = bodies.angular_momentum.at(slot);
    course.start.velocity = bodies.velocity.at(slot);
    course.start.spin = response.inverse_inertia * momentum;
    course.angular_momentum = momentum + course.angular_impulse;
    course.tentative = {course.start.velocity + gained,
                        response.inverse_inertia * course.angular_momentum, glm::dvec3{0.0}};
    course.mean = {course.start.velocity + 0.5 * gained,
                   0.5 * (course.start.spin + course.tentative.spin), glm::dvec3{0.0}};
}

void stop_in_time(const ContactBlock& block, const BodyCourse& course, const BodyForm& form,
                  const Scales& scales, BodyMotion& mean)
{
    const double sign = block.b != 0 ? 1.0 : -1.0;
    const glm::dvec3& start = course.start.velocity;
    const glm::dvec3 slip = start - glm::dot(start, block.normal) * block.normal;
    const double speed = std::sqrt(glm::dot(slip, slip));
    constexpr double hardly = 1e-9;
    if (speed <= hardly * scales.speed) return;
    const glm::dvec3 along = slip / speed;
    const double held = sign * (block.impulse.tangent_1 * glm::dot(block.tangent_1, along) +
                                block.impulse.tangent_2 * glm::dot(block.tangent_2, along));
    // What else pushes along the slip: it brought the body to a stop together with the friction.
    const double other = -form.mass * speed - held;
    const double braking = block.friction * block.normal_sum() - other;
    if (!(braking > form.mass * speed)) return;
    const double share = form.mass * speed / braking; // of the tick, until the stop
    mean.velocity -= (0.5 * (1.0 - share)) * slip;
}

void arrive(const BodyCourse& course, Bodies& bodies, Slot slot, ContactSolver& solver, double tick)
{
    const SolverIndex index = slot + 1;
    const BodyMotion& mean = solver.mean(index);
    const BodyMotion& ending = solver.ending(index);
    turn(course, bodies, slot, mean, tick);
    bodies.position.put(slot, bodies.position.at(slot) + tick * mean.velocity);
    bodies.velocity.put(slot, ending.velocity);
    bodies.angular_momentum.put(
        slot, course.angular_momentum + about_free_axes(bodies.form[slot], ending.angular_impulse));
}

} // namespace hapnet::scene
