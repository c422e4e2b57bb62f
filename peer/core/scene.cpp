// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/scene.hpp"

#include <bit>

namespace hapnet::peer {

Scene paper_scene()
{
    Scene scene;
    scene.cube.half = glm::dvec3{0.020};
    scene.static_cube.half = glm::dvec3{0.020};
    scene.static_cube.centre = {{0.1147, 0.0, 0.030}};
    return scene;
}

std::uint64_t hash(const Scene& scene)
{
    // FNV-1a over the bits of every number, in the order of the declaration.
    std::uint64_t hash = 0xcbf29ce484222325U;
    const auto add = [&hash](double value) {
        const auto bits = std::bit_cast<std::uint64_t>(value + 0.0); // -0 counts as 0
        for (unsigned shift = 0; shift < 64; shift += 8) {
            hash ^= (bits >> shift) & 0xffU;
            hash *= 0x100000001b3U;
        }
    };
    for (const Box& box : {scene.cube, scene.static_cube}) {
        for (const glm::dvec3& v : {box.centre.value, box.half}) {
            add(v.x);
            add(v.y);
            add(v.z);
        }
    }
    for (const double value :
         {scene.cube_mass_kg, scene.drag_ns_per_m, scene.gravity_m_per_s2, scene.hip_radius_m,
          scene.stiffness_n_per_m, scene.damping_ns_per_m, scene.force_max_n, scene.grip_reach_m}) {
        add(value);
    }
    return hash;
}

} // namespace hapnet::peer
