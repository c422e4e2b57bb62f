// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/space.hpp"

#include <cstdint>

namespace hapnet::peer {

/// An axis-parallel box: its centre and half its edges, metres.
struct Box {
    base::Position centre;
    glm::dvec3 half{0.0};
};

/// The shared scene: one movable cube that slides on a platform, one static cube, and the two
/// hands' spheres (HIPs). The platform carries the cube but is not felt by a hand. The cube does
/// not rotate.
struct Scene {
    Box cube;        // where it starts; its lower face rests on the platform
    Box static_cube; // stops the movable one, and is felt
    double cube_mass_kg = 0.1;
    double drag_ns_per_m = 10.0; // viscous friction on the platform
    double gravity_m_per_s2 = 9.81;
    double hip_radius_m = 0.005;
    double stiffness_n_per_m = 500.0; // of a contact between a HIP and a cube
    double damping_ns_per_m = 2.0;
    double force_max_n = 3.3;    // of one contact; the Omni's peak
    double grip_reach_m = 0.005; // how near the surface a hand must be to take hold of the cube
};

/// The paper's scene with the constants it leaves open chosen so that softness grows
/// monotonically with delay: drag >= sqrt(2 k m). The static cube stands where it stops the
/// moving one at x = 74.7 mm, offset in z so that it leaves the right hand its way.
[[nodiscard]] Scene paper_scene();

/// Equal for equal scenes on every machine; peers refuse each other when it differs.
[[nodiscard]] std::uint64_t hash(const Scene& scene);

} // namespace hapnet::peer
