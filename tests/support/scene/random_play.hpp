// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/world.hpp"

#include <utility>
#include <vector>

namespace hapnet::test {

/// A force at a point and a torque, or an impulse at a point, relative to the body's centre.
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

/// A command to a kinematic body: velocities, or a place relative to its present one.
struct Drive {
    scene::BodyId body = 0;
    glm::dvec3 velocity{0.0};
    glm::dvec3 spin{0.0};
    bool is_way = false;
};

/// The inputs of a world before one of its ticks.
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

/// Limits on random scenes.
struct PlayLimits {
    std::uint32_t bodies_max = 40;
    std::uint32_t ticks_min = 20;
    std::uint32_t ticks_max = 60;
    // Additions to the scene that the seed gives.
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

/// True if a world accepts a twist of this body, which exists and was not thrown out of reach.
[[nodiscard]] bool is_in_reach(const glm::dvec3& position, const Twist& twist);

/// Gives a world its inputs of a tick. Only a blow that is too strong may be refused. Twists out of
/// reach are left out.
void feed(scene::World& world, const TickInputs& inputs);

/// Returns the scene and its inputs, mirrored in the plane x = 0.
[[nodiscard]] RandomPlay mirrored(RandomPlay play);
[[nodiscard]] scene::BodyState mirrored(scene::BodyState state);

} // namespace hapnet::test
