// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/scene/course.hpp"

namespace hapnet::bench {

/// Returns the state of the first body of a course after its duration, under its own spin, gravity
/// and the hands' springs alone. Integrated by Runge and Kutta's fourth order in steps so short
/// that the error is far below 1e-10 m and rad.
[[nodiscard]] scene::BodyState reference_end(const Course& course);

/// The angle between two orientations, radians.
[[nodiscard]] double angle_between(const glm::dquat& a, const glm::dquat& b);

/// World-frame angular momentum of a solid box, and its energy of rotation.
[[nodiscard]] glm::dvec3 angular_momentum(const scene::BodyDescription& body,
                                          const scene::BodyState& state);
[[nodiscard]] double kinetic_energy(const scene::BodyDescription& body,
                                    const scene::BodyState& state);

} // namespace hapnet::bench
