// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/scene/reference.hpp"

#include "tests/bench/scene/penalty.hpp"

namespace hapnet::bench {

namespace {

// The order of the method is lost in steps in which a touch begins or ends, so these are shorter.
constexpr double free_step_s = 2e-5;
constexpr double touched_step_s = 5e-7;

/// A body's state with its angular momentum; also its rate of change.
struct Motion {
    glm::dvec3 position{0.0};
    glm::dvec3 velocity{0.0};
    glm::dquat orientation{0.0, 0.0, 0.0, 0.0};
    glm::dvec3 angular_momentum{0.0};

    friend Motion operator+(const Motion& a, const Motion& b)
    {
        return {a.position + b.position, a.velocity + b.velocity, a.orientation + b.orientation,
                a.angular_momentum + b.angular_momentum};
    }
    friend Motion operator*(double s, const Motion& a)
    {
        return {s * a.position, s * a.velocity, a.orientation * s, s * a.angular_momentum};
    }
};

/// The moments of inertia of a solid box about its own axes.
glm::dvec3 moments_of(const scene::BodyDescription& body)
{
    const glm::dvec3 square = body.half * body.half;
    return body.mass_kg / 3.0 *
           glm::dvec3{square.y + square.z, square.x + square.z, square.x + square.y};
}

glm::dquat unit(const glm::dquat& q) { return q / std::sqrt(glm::dot(q, q)); }

scene::BodyState state_of(const scene::BodyDescription& body, const Motion& motion)
{
    const glm::dquat q = unit(motion.orientation);
    const glm::dvec3 turning = glm::conjugate(q) * motion.angular_momentum / moments_of(body);
    return {{motion.position}, q, {motion.velocity}, q * turning};
}

Motion rate_of(const Course& course, const Motion& motion, double time_s)
{
    const scene::BodyDescription& body = course.scene.bodies[0];
    const scene::BodyState state = state_of(body, motion);
    Motion rate;
    rate.position = motion.velocity;
    rate.velocity = course.scene.gravity;
    const glm::dvec3& w = state.angular_velocity;
    rate.orientation = 0.5 * (glm::dquat{0.0, w.x, w.y, w.z} * motion.orientation);
    for (std::uint32_t i = 0; course.hands && i < course.scene.hands.count; ++i) {
        const Load load = penalty(state, body.half, course.hands(i, time_s), course.scene.hands);
        rate.velocity += load.force / body.mass_kg;
        rate.angular_momentum += glm::cross(load.point - motion.position, load.force);
    }
    return rate;
}

} // namespace

scene::BodyState reference_end(const Course& course)
{
    const scene::BodyDescription& body = course.scene.bodies[0];
    const scene::BodyState start{body.position, body.orientation, body.velocity,
                                 body.angular_velocity};
    Motion now{body.position.value, body.velocity.value, body.orientation,
               angular_momentum(body, start)};
    const double step_s = course.hands ? touched_step_s : free_step_s;
    const auto steps = std::llround(course.duration_s / step_s);
    for (long long i = 0; i < steps; ++i) {
        const double t = static_cast<double>(i) * step_s, middle = t + step_s / 2.0;
        const Motion a = rate_of(course, now, t);
        const Motion b = rate_of(course, now + step_s / 2.0 * a, middle);
        const Motion c = rate_of(course, now + step_s / 2.0 * b, middle);
        const Motion d = rate_of(course, now + step_s * c, t + step_s);
        now = now + step_s / 6.0 * (a + 2.0 * b + 2.0 * c + d);
        now.orientation = unit(now.orientation);
    }
    return state_of(body, now);
}

double angle_between(const glm::dquat& a, const glm::dquat& b)
{
    const glm::dquat turn = glm::conjugate(a) * b;
    const glm::dvec3 axis{turn.x, turn.y, turn.z};
    return 2.0 * std::atan2(std::sqrt(glm::dot(axis, axis)), std::abs(turn.w));
}

glm::dvec3 angular_momentum(const scene::BodyDescription& body, const scene::BodyState& state)
{
    const glm::dvec3 turning = glm::conjugate(state.orientation) * state.angular_velocity;
    return state.orientation * (moments_of(body) * turning);
}

double kinetic_energy(const scene::BodyDescription& body, const scene::BodyState& state)
{
    const glm::dvec3& v = state.velocity.value;
    return 0.5 * body.mass_kg * glm::dot(v, v) +
           0.5 * glm::dot(angular_momentum(body, state), state.angular_velocity);
}

} // namespace hapnet::bench
