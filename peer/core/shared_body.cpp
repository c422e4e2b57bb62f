// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/shared_body.hpp"

#include "proto/wire/message.hpp"
#include "scene/mass.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <string>

namespace hapnet::peer {

namespace {

/// Returns the body's name for people.
std::string named(const scene::BodyDescription& body, std::size_t index)
{
    return body.name.empty() ? fmt::format("body {}", index + 1)
                             : fmt::format("body '{}'", body.name);
}

double reach_of(const scene::BodyDescription& body)
{
    double reach_m = 0.0;
    for (const scene::BodyPart& part : scene::parts_of(body))
        reach_m = std::max(reach_m, part.radius);
    return reach_m;
}

/// Refuses everything in a scene that sessions do not support, except bodies.
base::Result<void> check_hands(const scene::Description& scene, bool is_like_the_papers)
{
    if (scene.hands.count == 0) return base::fail("a session needs a hand; this scene has none");
    if (!scene.own_hands.empty()) {
        return base::fail("the hands of a session are all alike: leave out [[hand]]");
    }
    if (scene.hands.friction == 0.0) return {};
    if (!is_like_the_papers) {
        return base::fail("the 'friction' of [hips] is for one body that does not turn: set "
                          "static_friction instead");
    }
    const bool is_own =
        std::ranges::any_of(scene.bodies, [](const auto& body) { return body.feel.is_own(); });
    if (scene.hands.static_friction > 0.0 || is_own) {
        return base::fail("the 'friction' of [hips] goes with their own stiffness and without "
                          "static_friction: set static_friction alone");
    }
    return {};
}

base::Result<void> check_bodies(const scene::Description& scene)
{
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        if (!scene.bodies[i].kinematic) continue;
        return base::fail(fmt::format("{} moves by itself: a session's copies would not have it at "
                                      "the same place; set fixed = true",
                                      named(scene.bodies[i], i)));
    }
    return {};
}

} // namespace

base::Result<std::vector<SharedBody>> shared_bodies(const scene::Description& scene)
{
    if (auto sound = check_bodies(scene); !sound) return tl::unexpected{sound.error()};
    std::vector<SharedBody> bodies;
    std::size_t movable = 0;
    std::string beyond; // name of the first body for which there is no room
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        const scene::BodyDescription& body = scene.bodies[i];
        if (!body.movable) continue;
        if (++movable == wire::bodies_max + 1) beyond = named(body, i);
        if (movable > wire::bodies_max) continue;
        if (i > wire::BodyState::id_max) {
            return base::fail(fmt::format("a movable body of a session must be among the first {} "
                                          "of its scene; {} is number {}",
                                          wire::BodyState::id_max + 1, named(body, i), i + 1));
        }
        bodies.push_back({static_cast<scene::BodyId>(i), body.turning, reach_of(body)});
    }
    if (movable == 0) return base::fail("a session needs a movable body; this scene has none");
    if (movable > wire::bodies_max) {
        return base::fail(fmt::format("a session shares at most {} movable bodies, and this scene "
                                      "has {}: set fixed = true from {} on",
                                      wire::bodies_max, movable, beyond));
    }
    if (auto sound = check_hands(scene, is_one_without_turning(bodies)); !sound) {
        return tl::unexpected{sound.error()};
    }
    return bodies;
}

base::Result<scene::BodyId> shared_body(const scene::Description& scene)
{
    return shared_bodies(scene).map([](const auto& bodies) { return bodies.front().id; });
}

bool is_one_without_turning(std::span<const SharedBody> bodies)
{
    return bodies.size() == 1 && !bodies.front().turns();
}

} // namespace hapnet::peer
