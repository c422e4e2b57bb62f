// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/scene/hip/surface.hpp"

#include <cmath>

namespace hapnet::scene {

Surface::Surface(const HipSpring& spring, const glm::dmat3& axes)
    : point_{spring.arm * axes}, normal_{spring.normal * axes}, radius_{spring.radius}
{
    constexpr double none = 1e-9; // rounding of a part that is 0
    for (const int axis : {0, 1, 2}) {
        if (std::abs(normal_[axis]) <= none) continue;
        is_bound_[axis] = 1.0;
        ++bound_;
    }
    if (bound_ == 1) normal_ = {std::copysign(is_bound_.x, normal_.x),
                                std::copysign(is_bound_.y, normal_.y),
                                std::copysign(is_bound_.z, normal_.z)};
}

Hold Surface::at(const glm::dmat3& axes, const glm::dvec3& hand) const
{
    const glm::dvec3 away = is_bound_ * (hand * axes - point_);
    double distance = glm::dot(normal_, away);
    glm::dvec3 normal = normal_;
    if (bound_ > 1) {
        const double length = std::sqrt(glm::dot(away, away));
        // Nearer to an edge than any surface is, a direction means nothing.
        if (length > 1e-9 * radius_) {
            distance = length;
            normal = away / length;
        }
    }
    Hold hold;
    hold.normal = axes * normal;
    hold.lever = glm::cross(hand, hold.normal);
    hold.depth = radius_ - distance;
    return hold;
}

} // namespace hapnet::scene
