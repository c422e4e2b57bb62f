// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/hand/surface.hpp"

#include "scene/hand/passivity.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::scene {

BoxSurface::BoxSurface(const HandSpring& spring, const BodyDynamics& dynamics,
                       const glm::dmat3& axes)
    : half_{dynamics.half - dynamics.rounding},
      radius_{spring.radius + dynamics.rounding},
      part_{spring.part}
{
    glm::dvec3 normal = spring.normal * axes;
    double rounded = dynamics.rounding;
    if (part_ != nullptr) {
        rounded = part_->rounding;
        half_ = part_->half - rounded;
        radius_ = spring.radius + rounded;
        normal = normal * part_->axes;
    }
    const glm::dvec3 size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    face_[axis] = normal[axis] < 0.0 ? -1.0 : 1.0;
    constexpr double rounding = 1e-9;
    is_face_ = rounded == 0.0 && size.x + size.y + size.z - size[axis] <= rounding;
}

bool BoxSurface::is_amid_face(const glm::dmat3& axes, const glm::dvec3& hand) const
{
    if (!is_face_) return false;
    constexpr double amid = 0.9;
    glm::dvec3 place = hand * axes;
    if (part_ != nullptr) place = (place - part_->at) * part_->axes;
    const glm::dvec3 off = glm::abs(place) - amid * half_;
    return (off.x <= 0.0 || face_.x != 0.0) && (off.y <= 0.0 || face_.y != 0.0) &&
           (off.z <= 0.0 || face_.z != 0.0);
}

ContactGeometry BoxSurface::at(const glm::dmat3& axes, const glm::dvec3& hand) const
{
    if (part_ == nullptr) return at_box(axes, hand);
    ContactGeometry geometry = at_box(axes * part_->axes, hand - axes * part_->at);
    geometry.lever = glm::cross(hand, geometry.normal);
    return geometry;
}

ContactGeometry BoxSurface::at_box(const glm::dmat3& axes, const glm::dvec3& hand) const
{
    const glm::dvec3 centre = hand * axes;
    double distance = glm::dot(face_, centre) - glm::dot(glm::abs(face_), half_);
    glm::dvec3 normal = face_;
    // Beside the face its plane does not count: far out there a force on it would turn the body
    // with a long lever.
    const glm::dvec3 beside = (1.0 - glm::abs(face_)) * (glm::abs(centre) - half_);
    const bool is_beside = beside.x > 0.0 || beside.y > 0.0 || beside.z > 0.0;
    if (distance >= 0.0 || !is_face_ || is_beside) {
        const glm::dvec3 away = centre - glm::clamp(centre, -half_, half_);
        const double square = glm::dot(away, away);
        if (square > 0.0) {
            distance = std::sqrt(square);
            normal = away / distance;
        }
    }
    ContactGeometry geometry;
    geometry.normal = axes * normal;
    geometry.lever = glm::cross(hand, geometry.normal);
    geometry.depth = radius_ - distance;
    return geometry;
}

namespace {

/// Returns the share of a further impulse with which the spring gives at most `most` in total.
double share_within(const glm::dvec3& given, const glm::dvec3& more, double most)
{
    if (std::isinf(most)) return 1.0;
    const double square = glm::dot(more, more);
    const double along = glm::dot(given, more);
    const double room = most * most - glm::dot(given, given);
    if (square + 2.0 * along <= room) return 1.0;
    if (room <= 0.0) return 0.0;
    return (std::sqrt(along * along + square * room) - along) / square;
}

} // namespace

glm::dvec3 mass_of(const BodyDynamics& dynamics)
{
    const glm::dvec3& light = dynamics.inverse_mass;
    const double most = std::max(std::max(light.x, light.y), light.z);
    const double mass = most > 0.0 ? 1.0 / most : 0.0;
    return {light.x > 0.0 ? mass : 0.0, light.y > 0.0 ? mass : 0.0, light.z > 0.0 ? mass : 0.0};
}

void correct_energy(const EnergyCorrection& settling, const HandSpring& spring,
                    const SpringDepths& depths, SpringImpulse& work)
{
    MovingBody& body = settling.body;
    const double missed =
        spring_energy(spring, depths.true_m) - spring_energy(spring, depths.followed);
    const glm::dvec3 velocity = body.velocity - spring.velocity;
    const glm::dvec3 momentum = mass_of(settling.dynamics) * velocity;
    const double twice =
        glm::dot(momentum, velocity) +
        glm::dot(body.angular_momentum, settling.inverse_inertia * body.angular_momentum);
    constexpr double most = 0.03;
    if (!(twice > 0.0)) return;
    double scale = std::min(-missed / twice, most);
    if (scale < -most) scale = std::sqrt(std::max(1.0 + 2.0 * scale, 0.0)) - 1.0;
    scale *= share_within(work.impulse, scale * momentum, spring.force_max * settling.tick);
    body.velocity += scale * (settling.dynamics.inverse_mass * momentum);
    body.angular_momentum *= 1.0 + scale;
    work.impulse += scale * momentum;
}

} // namespace hapnet::scene
