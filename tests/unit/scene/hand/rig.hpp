// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bodies.hpp"
#include "scene/hand/advance.hpp"
#include "scene/maths/rotation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <vector>

namespace hapnet::scene::testing {

struct Hand {
    glm::dvec3 position{0.0};
    glm::dvec3 velocity{0.0};
    double stiffness = 1000.0;
    double damping = 0.0;
    double force_max = std::numeric_limits<double>::infinity();
    double radius = 0.005;
};

/// A box among hands. The contacts are found again for every tick.
struct Rig {
    glm::dvec3 half{0.02};
    double mass = 0.1;
    MovingBody body{};
    std::vector<Hand> hands{};
    glm::dvec3 acceleration{0.0};
    std::array<SpringImpulse, 8> work{};
    PressedModes modes{};

    [[nodiscard]] glm::dmat3 inverse_inertia(const MovingBody& of) const
    {
        const glm::dmat3 axes = axes_of(of.orientation);
        const glm::dvec3 light = 1.0 / box_inertia(mass, half);
        glm::dmat3 scaled = axes;
        for (int axis = 0; axis < 3; ++axis) scaled[axis] *= light[axis];
        return scaled * glm::transpose(axes);
    }

    [[nodiscard]] HandSpring touch(const MovingBody& of, const Hand& hand) const
    {
        const glm::dmat3 axes = axes_of(of.orientation);
        const glm::dvec3 centre = (hand.position - of.position) * axes;
        glm::dvec3 nearest = glm::clamp(centre, -half, half);
        const glm::dvec3 away = centre - nearest;
        double distance = std::sqrt(glm::dot(away, away));
        glm::dvec3 normal{0.0};
        if (distance > 0.0) {
            normal = away / distance;
        } else {
            const glm::dvec3 depth = half - glm::abs(centre);
            const int axis = depth.x <= depth.y && depth.x <= depth.z ? 0
                             : depth.y <= depth.z                     ? 1
                                                                      : 2;
            normal[axis] = centre[axis] < 0.0 ? -1.0 : 1.0;
            nearest[axis] = normal[axis] * half[axis];
            distance = -depth[axis];
        }
        HandSpring spring;
        for (int axis = 0; axis < 3; ++axis) {
            const glm::dvec3 others = glm::abs(centre) * (1.0 - glm::abs(normal));
            if (std::abs(normal[axis]) == 1.0)
                spring.is_amid_face = glm::all(glm::lessThanEqual(others, 0.9 * half));
        }
        spring.normal = axes * normal;
        spring.arm = axes * nearest;
        spring.radius = hand.radius;
        spring.gap = distance - hand.radius;
        spring.velocity = hand.velocity;
        spring.stiffness = hand.stiffness;
        spring.damping = hand.damping;
        spring.force_max = hand.force_max;
        return spring;
    }

    [[nodiscard]] BodyDynamics dynamics() const
    {
        BodyDynamics dynamics;
        dynamics.half = half;
        dynamics.inverse_mass = glm::dvec3{1.0 / mass};
        dynamics.inverse_inertia = inverse_inertia(body);
        dynamics.rotates_uniformly = half.x == half.y && half.y == half.z;
        dynamics.acceleration = acceleration;
        return dynamics;
    }

    void tick(double seconds)
    {
        std::vector<HandSpring> springs;
        for (const Hand& hand : hands) springs.push_back(touch(body, hand));
        advance(body, dynamics(), springs, work, seconds, modes);
        for (Hand& hand : hands) hand.position += seconds * hand.velocity;
    }

    void run(double seconds, double tick_s)
    {
        const auto ticks = std::lround(seconds / tick_s);
        for (long i = 0; i < ticks; ++i) tick(tick_s);
    }

    /// Energy of motion and of the springs.
    [[nodiscard]] double energy() const
    {
        const glm::dvec3& momentum = body.angular_momentum;
        double sum = 0.5 * mass * glm::dot(body.velocity, body.velocity) +
                     0.5 * glm::dot(momentum, inverse_inertia(body) * momentum);
        for (const Hand& hand : hands) {
            const double depth = std::max(-touch(body, hand).gap, 0.0);
            sum += 0.5 * hand.stiffness * depth * depth;
        }
        return sum;
    }
};

/// The same by the classical Runge-Kutta rule in small steps: the reference.
class Reference {
public:
    explicit Reference(const Rig& rig) : rig_{rig} {}

    MovingBody run(double seconds, int steps)
    {
        const double step = seconds / steps;
        for (int i = 0; i < steps; ++i) {
            const Rate k1 = rate(rig_.body, i * step);
            const Rate k2 = rate(moved(k1, 0.5 * step), (i + 0.5) * step);
            const Rate k3 = rate(moved(k2, 0.5 * step), (i + 0.5) * step);
            const Rate k4 = rate(moved(k3, step), (i + 1.0) * step);
            Rate mean;
            mean.velocity = (k1.velocity + 2.0 * (k2.velocity + k3.velocity) + k4.velocity) / 6.0;
            mean.force = (k1.force + 2.0 * (k2.force + k3.force) + k4.force) / 6.0;
            mean.turning = (k1.turning + 2.0 * (k2.turning + k3.turning) + k4.turning) / 6.0;
            mean.torque = (k1.torque + 2.0 * (k2.torque + k3.torque) + k4.torque) / 6.0;
            rig_.body = moved(mean, step);
        }
        return rig_.body;
    }

private:
    struct Rate {
        glm::dvec3 velocity{0.0}, force{0.0}, turning{0.0}, torque{0.0};
    };

    [[nodiscard]] MovingBody moved(const Rate& rate, double step) const
    {
        MovingBody body = rig_.body;
        body.position += step * rate.velocity;
        body.velocity += (step / rig_.mass) * rate.force;
        body.angular_momentum += step * rate.torque;
        body.orientation = rotated(body.orientation, step * rate.turning);
        return body;
    }

    [[nodiscard]] Rate rate(const MovingBody& body, double time) const
    {
        Rate rate;
        rate.velocity = body.velocity;
        rate.force = rig_.mass * rig_.acceleration;
        rate.turning = rig_.inverse_inertia(body) * body.angular_momentum;
        for (Hand hand : rig_.hands) {
            hand.position += time * hand.velocity;
            const HandSpring spring = rig_.touch(body, hand);
            if (spring.gap >= 0.0) continue;
            const double closing =
                glm::dot(spring.normal,
                         body.velocity + glm::cross(rate.turning, spring.arm) - spring.velocity);
            const double force = std::clamp(
                -spring.stiffness * spring.gap + spring.damping * closing, 0.0, spring.force_max);
            rate.force -= force * spring.normal;
            rate.torque -= force * glm::cross(spring.arm, spring.normal);
        }
        return rate;
    }

    Rig rig_;
};

inline double distance(const glm::dvec3& a, const glm::dvec3& b)
{
    const glm::dvec3 d = a - b;
    return std::sqrt(glm::dot(d, d));
}

} // namespace hapnet::scene::testing
