// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/scene/spinning.hpp"

#include "scene/mass.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace hapnet::test {

using scene::BodyDescription;
using scene::Turning;

glm::dvec3 inertia_about_axes(const BodyDescription& form)
{
    const glm::dvec3 own = scene::inertia_of(form);
    if (form.parts.empty()) return own; // the same axes, or equal moments
    const glm::dmat3 axes = glm::mat3_cast(scene::frame_of_mass(form).orientation);
    glm::dvec3 about{0.0};
    for (const int axis : {0, 1, 2}) about += axes[axis] * axes[axis] * own[axis];
    return about;
}

double spinning_energy(const BodyDescription& form, const glm::dquat& orientation,
                       const glm::dvec3& momentum)
{
    const glm::dvec3 inertia = scene::inertia_of(form);
    switch (form.turning) {
    case Turning::locked: return 0.0;
    case Turning::free: {
        const glm::dvec3 own = glm::conjugate(orientation) * momentum;
        return 0.5 * glm::dot(own, own / inertia);
    }
    default: break;
    }
    // About one axis of the world, which is the same axis of the body's: see BodyProperties.
    const int axis = static_cast<int>(form.turning) - static_cast<int>(Turning::about_x);
    return 0.5 * momentum[axis] * momentum[axis] / inertia_about_axes(form)[axis];
}

double spinning_range(const BodyDescription& form, const glm::dvec3& momentum)
{
    if (form.turning != Turning::free) return 0.0;
    const glm::dvec3 inertia = scene::inertia_of(form);
    const double least = std::min({inertia.x, inertia.y, inertia.z});
    const double most = std::max({inertia.x, inertia.y, inertia.z});
    return 0.5 * glm::dot(momentum, momentum) * (1.0 / least - 1.0 / most);
}

} // namespace hapnet::test
