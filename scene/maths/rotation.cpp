// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/maths/rotation.hpp"

#include "proto/base/math.hpp"

#include <glm/geometric.hpp>

namespace hapnet::scene {

namespace {

/// Returns the angular velocity, in the world's frame, of a body in this orientation.
glm::dvec3 angular_velocity(const glm::dquat& orientation, const FreeRotation& spin)
{
    const glm::dmat3 axes = axes_of(orientation);
    const glm::dvec3& l = spin.angular_momentum;
    return axes[0] * (spin.inverse_inertia.x * glm::dot(axes[0], l)) +
           axes[1] * (spin.inverse_inertia.y * glm::dot(axes[1], l)) +
           axes[2] * (spin.inverse_inertia.z * glm::dot(axes[2], l));
}

} // namespace

HalfAngle half_angle(double z)
{
    constexpr double none = 1e-17; // cosine and sinc both round to 1 below it
    if (z <= none) return {};
    if (z <= small_half_angle_max) return small_half_angle(z);
    const double half = std::sqrt(z);
    if (!(half <= 1e6)) return {};
    return {base::cos(half), base::sin(half) / half};
}

glm::dquat rotation_by(const glm::dvec3& angle)
{
    const glm::dvec3 half = 0.5 * angle;
    const double z = glm::dot(half, half);
    if (!(z <= 1e12)) return {1.0, 0.0, 0.0, 0.0};
    const HalfAngle turn = half_angle(z);
    return {turn.cosine, turn.sinc * half.x, turn.sinc * half.y, turn.sinc * half.z};
}

glm::dmat3 axes_of(const glm::dquat& orientation)
{
    const double xx = orientation.x * orientation.x;
    const double yy = orientation.y * orientation.y;
    const double zz = orientation.z * orientation.z;
    const double xy = orientation.x * orientation.y;
    const double xz = orientation.x * orientation.z;
    const double yz = orientation.y * orientation.z;
    const double wx = orientation.w * orientation.x;
    const double wy = orientation.w * orientation.y;
    const double wz = orientation.w * orientation.z;
    return {1.0 - 2.0 * (yy + zz), 2.0 * (xy + wz),       2.0 * (xz - wy),
            2.0 * (xy - wz),       1.0 - 2.0 * (xx + zz), 2.0 * (yz + wx),
            2.0 * (xz + wy),       2.0 * (yz - wx),       1.0 - 2.0 * (xx + yy)};
}

glm::dvec3 mean_spin(const glm::dquat& orientation, const FreeRotation& spin, double tick)
{
    const glm::dvec3 first = angular_velocity(orientation, spin);
    const glm::dquat halfway = rotation_by((0.5 * tick) * first) * orientation;
    return angular_velocity(halfway, spin);
}

glm::dvec3 turn_between(const glm::dquat& from, const glm::dquat& to)
{
    glm::dquat by = to * glm::conjugate(from);
    if (by.w < 0.0) by = -by;
    // The root of a unit quaternion turns half as far. After four roots the series for the arc sine
    // has an argument of at most pi/32.
    double times = 2.0;
    for (int root = 0; root < 4; ++root) {
        by = glm::dquat{1.0 + by.w, by.x, by.y, by.z};
        const double square = by.w * by.w + by.x * by.x + by.y * by.y + by.z * by.z;
        by = by * (1.0 / std::sqrt(square));
        times *= 2.0;
    }
    const double sine2 = by.x * by.x + by.y * by.y + by.z * by.z;
    const double stretch =
        1.0 + sine2 * (1.0 / 6.0 +
                       sine2 * (3.0 / 40.0 + sine2 * (15.0 / 336.0 + sine2 * (105.0 / 3456.0))));
    return (times * stretch) * glm::dvec3{by.x, by.y, by.z};
}

namespace {

/// Returns the rotation about the angular momentum with the spin's part along it. It keeps the
/// energy of any body exactly, and omits the body's nutation.
glm::dquat precessed(const glm::dquat& orientation, const FreeRotation& spin, double time)
{
    const glm::dvec3& momentum = spin.angular_momentum;
    const double square = glm::dot(momentum, momentum);
    if (square == 0.0) return orientation;
    const double along = glm::dot(momentum, angular_velocity(orientation, spin)) / square;
    return rotated(orientation, (time * along) * momentum);
}

/// Makes one step of the midpoint rule, corrected to the initial energy.
glm::dquat midpoint_step(const glm::dquat& orientation, const FreeRotation& spin, double time)
{
    const glm::dvec3 first = angular_velocity(orientation, spin);
    const glm::dquat halfway = rotation_by((0.5 * time) * first) * orientation;
    const glm::dquat end = rotated(orientation, time * angular_velocity(halfway, spin));
    const auto found = with_energy(end, spin, 0.5 * glm::dot(spin.angular_momentum, first));
    return found ? *found : precessed(orientation, spin, time);
}

} // namespace

std::optional<glm::dquat> with_energy(const glm::dquat& orientation, const FreeRotation& spin,
                                      double energy)
{
    // Newton's method across the level curves of the energy L w / 2 doubles its digits in each
    // round.
    constexpr int rounds_max = 5;
    constexpr double flat = 1e-9, far = 0.1;                // radians
    constexpr double rounding = 2e-15, good_enough = 1e-13; // shares of the energy
    const glm::dvec3& momentum = spin.angular_momentum;
    glm::dquat found = orientation;
    for (int round = 0;; ++round) {
        const glm::dvec3 velocity = angular_velocity(found, spin);
        const double excess = 0.5 * glm::dot(momentum, velocity) - energy;
        if (std::abs(excess) <= rounding * energy) return found;
        const glm::dvec3 slope = glm::cross(velocity, momentum);
        const double steepness2 = glm::dot(slope, slope);
        const bool is_flat =
            steepness2 <= flat * flat * glm::dot(momentum, momentum) * glm::dot(velocity, velocity);
        if (is_flat || round == rounds_max || excess * excess >= far * far * steepness2) {
            if (std::abs(excess) <= good_enough * energy) return found;
            return std::nullopt;
        }
        found = rotated(found, (-excess / steepness2) * slope);
    }
}

glm::dquat rotated_freely(const glm::dquat& orientation, const FreeRotation& spin, double tick)
{
    // A step of the midpoint rule turns no farther than this.
    constexpr double step_max = 0.2; // radians
    constexpr double pieces_max = 64.0;
    const glm::dvec3 first = angular_velocity(orientation, spin);
    const double angle2 = tick * tick * glm::dot(first, first);
    if (angle2 <= step_max * step_max) return midpoint_step(orientation, spin, tick);
    const double steps = std::ceil(std::sqrt(angle2) / step_max);
    if (!(steps <= pieces_max)) return precessed(orientation, spin, tick);
    glm::dquat end = orientation;
    const int count = static_cast<int>(steps);
    for (int step = 0; step < count; ++step) end = midpoint_step(end, spin, tick / steps);
    return end;
}

} // namespace hapnet::scene
