// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/description.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace hapnet::test {

/// The moment of inertia about the only axis of the world about which a body turns, kg m^2.
[[nodiscard]] glm::dvec3 inertia_about_axes(const scene::BodyDescription& form);

/// The energy of rotation with an angular momentum, for the inertia of an orientation, J.
[[nodiscard]] double spinning_energy(const scene::BodyDescription& form,
                                     const glm::dquat& orientation, const glm::dvec3& momentum);

/// The largest difference of rotational energy between orientations at one momentum, J.
[[nodiscard]] double spinning_range(const scene::BodyDescription& form, const glm::dvec3& momentum);

} // namespace hapnet::test
