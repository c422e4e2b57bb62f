// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/world.hpp"

#include <utility>
#include <vector>

namespace hapnet::test {

/// What is done to a world before one of its ticks.
struct TickInputs {
    std::vector<scene::HandInput> hands;
    std::vector<std::pair<scene::BodyId, base::Force>> pushes;
    std::vector<std::pair<scene::BodyId, scene::BodyState>> places;
};

/// What random scenes are drawn from.
struct PlayLimits {
    std::uint32_t bodies_max = 40;
    std::uint32_t ticks_min = 20;
    std::uint32_t ticks_max = 60;
    bool joints = false; // adds joints to the scene that the seed gives without
};

/// A random scene and what happens to it.
struct RandomPlay {
    scene::Description description;
    scene::FreezeOptions options;
    bool overlaps = false; // bodies may begin inside each other and inside planes
    std::vector<TickInputs> ticks;
};

/// Boxes of one size or of many, alone, loose, in rows, stacked or inside each other; light, heavy,
/// smooth, rough and bouncing; that turn or do not; fixed ones; planes level and tilted; at rest or
/// as fast as 1000 m/s; hands that come near, push, grip, leave, and appear elsewhere; pushes, and
/// bodies that are put elsewhere. A pure function of the seed.
[[nodiscard]] RandomPlay random_play(std::uint64_t seed, const PlayLimits& limits = {});

/// Gives a world its inputs of a tick. None of them is refused.
void feed(scene::World& world, const TickInputs& inputs);

/// The scene and what happens to it as a mirror in the plane x = 0 shows them.
[[nodiscard]] RandomPlay mirrored(RandomPlay play);
[[nodiscard]] scene::BodyState mirrored(scene::BodyState state);

} // namespace hapnet::test
