// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/world.hpp"

#include <utility>
#include <vector>

namespace hapnet::test {

/// A force at a point and a torque, or an impulse at a point; the point from the body's centre.
struct Twist {
    scene::BodyId body = 0;
    glm::dvec3 force{0.0};
    glm::dvec3 at{0.0};
    glm::dvec3 torque{0.0};
};
struct Blow {
    scene::BodyId body = 0;
    glm::dvec3 impulse{0.0};
    glm::dvec3 at{0.0};
};

/// How a kinematic body goes on: with velocities, or to a place from where it is.
struct Drive {
    scene::BodyId body = 0;
    glm::dvec3 velocity{0.0};
    glm::dvec3 spin{0.0};
    bool is_way = false;
};

/// What is done to a world before one of its ticks.
struct TickInputs {
    std::vector<scene::HandInput> hands;
    std::vector<std::pair<scene::BodyId, base::Force>> pushes;
    std::vector<std::pair<scene::BodyId, scene::BodyState>> places;
    std::vector<Twist> twists;
    std::vector<Blow> blows;
    std::vector<Drive> drives;
};

/// From this seed on, below `elements_from`, some of the bodies are spheres and capsules.
inline constexpr std::uint64_t round_plays_from = 1'000'000'000;

/// From this seed on scenes have more elements: kinematic bodies, felt planes, fields of force,
/// springs and friction of their own; and pushes at points, torques, blows and drives.
inline constexpr std::uint64_t elements_from = 1'000'000'000'000;

/// What random scenes are drawn from.
struct PlayLimits {
    std::uint32_t bodies_max = 40;
    std::uint32_t ticks_min = 20;
    std::uint32_t ticks_max = 60;
    // What is added to the scene that the seed gives without.
    bool compounds = false; // further parts
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
/// bodies that are put elsewhere. From `elements_from` on, more. A pure function of the seed.
[[nodiscard]] RandomPlay random_play(std::uint64_t seed, const PlayLimits& limits = {});

/// Whether a world takes a twist of a body that is there, and not thrown out of all reach.
[[nodiscard]] bool is_in_reach(const glm::dvec3& position, const Twist& twist);

/// Gives a world its inputs of a tick. None of them is refused, but a blow that would be too much;
/// twists out of reach are left out.
void feed(scene::World& world, const TickInputs& inputs);

/// The scene and what happens to it as a mirror in the plane x = 0 shows them.
[[nodiscard]] RandomPlay mirrored(RandomPlay play);
[[nodiscard]] scene::BodyState mirrored(scene::BodyState state);

} // namespace hapnet::test
