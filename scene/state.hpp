// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bodies.hpp"
#include "scene/bounded.hpp"

#include <array>
#include <vector>

namespace hapnet::scene {

/// What holds for a frozen scene from its first tick to its last.
struct WorldConfig {
    std::vector<PlaneDescription> planes{};
    HandDescription hands{};
    glm::dvec3 gravity{0.0};
    double tick = 1e-3;   // seconds
    bool sleeping = true; // whether bodies at rest may fall asleep
};

/// What every tick profile works on: the bodies, what the hands do, and what they feel of it.
/// Everything that changes and that the next tick depends on lies here or in the profile's own
/// memory: a copy of both is a snapshot.
struct WorldState {
    Bodies bodies;
    std::array<HandInput, hands_max> hands{};
    std::array<HandTouch, hands_max> touches{};
    std::vector<glm::dvec3> pushes{};      // newtons by id, held for the next tick, then cleared
    Bounded<BodyId> pushed{};              // those of whom there is a push, each once
    std::vector<std::uint8_t> is_pushed{}; // by id
    std::uint64_t ticks = 0;
};

} // namespace hapnet::scene
