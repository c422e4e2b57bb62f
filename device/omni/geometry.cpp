// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/omni/geometry.hpp"

#include "proto/base/math.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::device::omni {

namespace {

/// Sines and cosines of the three angles.
struct Directions {
    glm::dvec3 sine;
    glm::dvec3 cosine;

    /// Returns the distance of the stylus from the waist's axis.
    [[nodiscard]] double reach() const { return link_m * (cosine.y + sine.z); }
};

Directions directions_of(const Joints& joints)
{
    const glm::dvec3& q = joints.angles;
    return {{base::sin(q.x), base::sin(q.y), base::sin(q.z)},
            {base::cos(q.x), base::cos(q.y), base::cos(q.z)}};
}

/// A direction in a plane. It is (1, 0) for a zero vector.
struct Heading {
    double cosine = 1.0;
    double sine = 0.0;
    double length = 0.0;

    Heading(double along, double across) : length{std::sqrt(along * along + across * across)}
    {
        if (!(length > 0.0)) return;
        cosine = along / length;
        sine = across / length;
    }
};

/// Returns the directions of the links at a position. The links form a triangle with the line from
/// shoulder to stylus. Both links are at the same angle h to this line, on either side, and its
/// length is 2 l cos h.
Directions directions_at(const base::Position& position)
{
    const Heading waist{position.z() + depth_m, -position.x()};
    const Heading line{waist.length, position.y() - height_m};
    const double cosine_h = std::min(line.length / (2.0 * link_m), 1.0);
    const double sine_h = std::sqrt(1.0 - cosine_h * cosine_h);
    const double sine_shoulder = line.sine * cosine_h + line.cosine * sine_h;
    const double cosine_shoulder = line.cosine * cosine_h - line.sine * sine_h;
    // The angle of the forearm from the horizontal; from the vertical it is a quarter turn more.
    const double sine_forearm = line.sine * cosine_h - line.cosine * sine_h;
    const double cosine_forearm = line.cosine * cosine_h + line.sine * sine_h;
    return {{waist.sine, sine_shoulder, cosine_forearm},
            {waist.cosine, cosine_shoulder, -sine_forearm}};
}

glm::dmat3 jacobian_of(const Directions& d)
{
    const glm::dvec3 waist{-d.reach() * d.cosine.x, 0.0, -d.reach() * d.sine.x};
    const glm::dvec3 shoulder{d.sine.x * d.sine.y, d.cosine.y, -d.cosine.x * d.sine.y};
    const glm::dvec3 forearm{-d.sine.x * d.cosine.z, d.sine.z, d.cosine.x * d.cosine.z};
    return glm::dmat3{waist, link_m * shoulder, link_m * forearm};
}

bool is_within(double angle, const JointRange& range, double slack)
{
    return angle >= range.least - slack && angle <= range.most + slack;
}

} // namespace

base::Position position_of(const Joints& joints)
{
    const Directions d = directions_of(joints);
    const double reach = d.reach();
    return {{-reach * d.sine.x, link_m * (d.sine.y - d.cosine.z) + height_m,
             reach * d.cosine.x - depth_m}};
}

Joints joints_of(const base::Position& position)
{
    const Directions d = directions_at(position);
    return {{std::atan2(d.sine.x, d.cosine.x), std::atan2(d.sine.y, d.cosine.y),
             std::atan2(d.sine.z, d.cosine.z)}};
}

glm::dmat3 jacobian(const Joints& joints) { return jacobian_of(directions_of(joints)); }

glm::dmat3 jacobian_at(const base::Position& position)
{
    return jacobian_of(directions_at(position));
}

bool is_reachable(const Joints& joints, double slack)
{
    const glm::dvec3& q = joints.angles;
    return is_within(q.x, waist_range, slack) && is_within(q.y, shoulder_range, slack) &&
           is_within(q.z - q.y, elbow_range, slack);
}

} // namespace hapnet::device::omni
