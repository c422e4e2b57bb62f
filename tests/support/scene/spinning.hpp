// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/description.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace hapnet::test {

/// About the world's axes, of a body that turns about one of them alone, kg m^2.
[[nodiscard]] glm::dvec3 inertia_about_axes(const scene::BodyDescription& form);

/// Of turning with an angular momentum, with the inertia of an orientation, J.
[[nodiscard]] double spinning_energy(const scene::BodyDescription& form,
                                     const glm::dquat& orientation, const glm::dvec3& momentum);

/// By how much the energy of turning with one angular momentum can differ with the orientation, J.
[[nodiscard]] double spinning_range(const scene::BodyDescription& form, const glm::dvec3& momentum);

} // namespace hapnet::test
