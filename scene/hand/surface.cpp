// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/hand/surface.hpp"

#include <cmath>

namespace hapnet::scene {

BoxSurface::BoxSurface(const HandSpring& spring, const glm::dvec3& half, const glm::dmat3& axes)
    : half_{half}, radius_{spring.radius}
{
    const glm::dvec3 normal = spring.normal * axes;
    const glm::dvec3 size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    face_[axis] = normal[axis] < 0.0 ? -1.0 : 1.0;
    constexpr double rounding = 1e-9;
    is_face_ = size.x + size.y + size.z - size[axis] <= rounding;
}

bool BoxSurface::is_amid_face(const glm::dmat3& axes, const glm::dvec3& hand) const
{
    if (!is_face_) return false;
    constexpr double amid = 0.9;
    const glm::dvec3 off = glm::abs(hand * axes) - amid * half_;
    return (off.x <= 0.0 || face_.x != 0.0) && (off.y <= 0.0 || face_.y != 0.0) &&
           (off.z <= 0.0 || face_.z != 0.0);
}

ContactGeometry BoxSurface::at(const glm::dmat3& axes, const glm::dvec3& hand) const
{
    const glm::dvec3 centre = hand * axes;
    double distance = glm::dot(face_, centre) - glm::dot(glm::abs(face_), half_);
    glm::dvec3 normal = face_;
    // Beside the face its plane is nothing: far out there it would turn the body by a long lever.
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

} // namespace hapnet::scene
