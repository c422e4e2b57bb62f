// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/flight.hpp"

#include "proto/base/math.hpp"
#include "scene/maths/rotation.hpp"
#include "scene/maths/vector.hpp"
#include "scene/rigid/free_flight.hpp"
#include "scene/rigid/integrate.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::scene {

namespace {

int longest_axis(const glm::dvec3& half)
{
    return half.x >= half.y && half.x >= half.z ? 0 : half.y >= half.z ? 1 : 2;
}

bool is_symmetric_top(const BodyProperties& properties)
{
    return properties.rounding > 0.0 && !properties.is_isotropic &&
           properties.turning == Turning::free;
}

} // namespace

glm::dquat Roll::turned(const glm::dquat& orientation, const BodyProperties& body, double at) const
{
    const double all = angle + rate * (at - time);
    if (all == 0.0) return orientation;
    glm::dvec3 turn{0.0};
    turn[longest_axis(body.half)] = all;
    return base::normalized(orientation * rotation_by(turn));
}

glm::dvec3 steady_spin(const glm::dquat& from, const glm::dquat& to, const glm::dvec3& mean,
                       double tick)
{
    constexpr double far = 0.2; // radians
    if (tick * length(mean) <= far) return mean;
    const glm::dvec3 turn = turn_between(from, to);
    const double angle = length(turn);
    if (angle == 0.0) return mean;
    const glm::dvec3 axis = turn / angle;
    const double rounds = std::round((tick * glm::dot(mean, axis) - angle) / base::two_pi);
    return ((angle + rounds * base::two_pi) / tick) * axis;
}

glm::dvec3 spin_of(const Bodies& bodies, Slot slot, const glm::dquat& orientation, Roll& roll)
{
    const BodyProperties& properties = bodies.properties[slot];
    const OrientedBox box{glm::dvec3{0.0}, axes_of(orientation), properties.half,
                          properties.rounding};
    const glm::dvec3 momentum = bodies.angular_momentum.at(slot);
    const glm::dvec3 spin = response_of(properties, box.axes).inverse_inertia * momentum;
    if (!is_symmetric_top(properties)) return spin;
    const glm::dvec3& light = properties.inverse_inertia;
    const glm::dvec3 steady = std::min({light.x, light.y, light.z}) * momentum;
    roll.rate = glm::dot(box.axes[longest_axis(properties.half)], spin - steady);
    return steady;
}

} // namespace hapnet::scene
