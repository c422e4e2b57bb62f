// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/scene/bodies.hpp"
#include "peer/core/scene/contact/box_box.hpp"
#include "peer/core/scene/stage.hpp"

#include <array>
#include <span>
#include <vector>

namespace hapnet::scene {

/// What a contact was last tick, so that the solver starts from it.
struct ContactMemory {
    BoxBoxMemory axis;
    std::uint32_t count = 0;
    std::array<std::uint32_t, manifold_points_max> feature{};
    std::array<double, manifold_points_max> normal_impulse{};
    glm::dvec3 friction_impulse{0.0}; // tangential, world's frame
    double torsion_impulse = 0.0;
};

/// Two bodies near each other: `a` < `b`, at least one of them movable and awake.
struct Pair {
    BodyId a = 0;
    BodyId b = 0;
    ContactMemory memory;
};

} // namespace hapnet::scene
