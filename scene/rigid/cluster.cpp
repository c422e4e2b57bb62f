// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/cluster.hpp"

#include "scene/maths/vector.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace hapnet::scene {

namespace {

/// Returns the inertia of a freely turning part, in the world's frame.
glm::dmat3 inertia_of(const ClusterPart& part)
{
    const glm::dmat3& axes = part.box.axes;
    const glm::dvec3& own = part.properties.inertia;
    return glm::dmat3{own.x * axes[0], own.y * axes[1], own.z * axes[2]} * glm::transpose(axes);
}

// Squared sine of the angle between two walls below which they count as one.
constexpr double same_wall_sine2 = 1e-6;

bool is_locked(const glm::dvec3& inverse_mass)
{
    return inverse_mass.x == 0.0 || inverse_mass.y == 0.0 || inverse_mass.z == 0.0;
}

} // namespace

void Cluster::count(const ClusterPart& part)
{
    const BodyProperties& properties = part.properties;
    mass_ += properties.mass;
    weighed_ += properties.mass * part.box.centre;
    momentum_ += properties.mass * part.velocity;
    if (is_locked(properties.inverse_mass)) turns_ = glm::dvec3{0.0};
    for (const int axis : {0, 1, 2}) {
        if (properties.inverse_mass[axis] == 0.0) free_[axis] = 0.0;
        if (properties.inverse_inertia[axis] == 0.0) turns_[axis] = 0.0;
    }
}

void Cluster::join(const ClusterPart& part)
{
    const double mass = part.properties.mass;
    const glm::dvec3 arm = part.box.centre - weighed_ / mass_;
    angular_momentum_ += part.angular_momentum + mass * glm::cross(arm, part.velocity);
    glm::dmat3 inertia = inertia_of(part);
    for (const int axis : {0, 1, 2}) {
        inertia[axis] -= mass * arm[axis] * arm;
        inertia[axis][axis] += mass * glm::dot(arm, arm);
    }
    inertia_ += inertia;
}

void Cluster::stick()
{
    velocity_ = free_ * momentum_ / mass_;
    spin_ = glm::dvec3{0.0};
    if (turns_ == glm::dvec3{0.0}) return;
    for (const int axis : {0, 1, 2}) {
        if (turns_[axis] != 0.0) continue;
        for (const int other : {0, 1, 2}) inertia_[axis][other] = inertia_[other][axis] = 0.0;
        inertia_[axis][axis] = 1.0;
    }
    spin_ = glm::inverse(inertia_) * (turns_ * angular_momentum_);
}

BodyMotion Cluster::motion_of(const ClusterPart& part) const
{
    return {velocity_ + glm::cross(spin_, part.box.centre - weighed_ / mass_), spin_, {}};
}

glm::dvec3 Cluster::angular_momentum_of(const ClusterPart& part) const
{
    // A body that turns about one axis of the world turns about the same axis of its own.
    if (part.properties.turning != Turning::free) return part.properties.inertia * spin_;
    return inertia_of(part) * spin_;
}

glm::dvec3 Cluster::stick_to_wall(const glm::dvec3& normal, const glm::dvec3& ground)
{
    const glm::dvec3 relative = free_ * (velocity_ - ground);
    const glm::dvec3 along = free_ * normal;
    const double size = length(along);
    const glm::dvec3 unit = size > 0.0 ? along / size : along;
    const glm::dvec3 both = glm::cross(wall_, unit);
    const double square = glm::dot(both, both);
    const std::uint32_t before = walls_++;
    glm::dvec3 kept{0.0};
    if (before == 0 || (before == 1 && square < same_wall_sine2)) {
        wall_ = unit;
        kept = relative - std::min(0.0, glm::dot(relative, unit)) * unit;
    } else if (before == 1 && free_ == glm::dvec3{1.0}) {
        kept = glm::dot(relative, both) / square * both;
    }
    const glm::dvec3 change = kept - relative;
    velocity_ += change;
    return change;
}

} // namespace hapnet::scene
