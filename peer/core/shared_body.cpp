// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/shared_body.hpp"

#include <algorithm>
#include <limits>
#include <spdlog/fmt/fmt.h>

namespace hapnet::peer {

base::Result<scene::BodyId> shared_body(const scene::Description& scene)
{
    using number_on_the_wire = std::uint16_t;
    const auto is_movable = [](const scene::BodyDescription& body) { return body.movable; };
    const auto& bodies = scene.bodies;
    const auto found = std::find_if(bodies.begin(), bodies.end(), is_movable);
    const auto count = std::count_if(found, bodies.end(), is_movable);
    if (count != 1) {
        return base::fail(fmt::format("a session needs exactly one movable body; this scene has {}",
                                      count == 0 ? "none" : fmt::to_string(count)));
    }
    if (found->turning != scene::Turning::locked) {
        return base::fail("sessions do not support rotating bodies yet: set turning = \"locked\"");
    }
    const auto is_kinematic = [](const scene::BodyDescription& body) { return body.kinematic; };
    if (std::any_of(bodies.begin(), bodies.end(), is_kinematic)) {
        return base::fail(
            "a session has no kinematic bodies yet: its two scenes would not have them "
            "at the same place");
    }
    const auto has_own_feel = [](const scene::BodyDescription& body) { return body.feel.is_own(); };
    if (!scene.own_hands.empty() || std::any_of(bodies.begin(), bodies.end(), has_own_feel)) {
        return base::fail(
            "a session has one stiffness and damping yet, those of [hips]: bodies and "
            "hands have none of their own");
    }
    if (scene.hands.static_friction > 0.0) {
        return base::fail("a session has the friction of [hips] alone yet: set friction instead of "
                          "static_friction");
    }
    if (!scene.fields.empty()) return base::fail("a session has no fields of force yet");
    if (!scene.joints.empty()) {
        return base::fail("a session has no joints yet: leave out hinges, sliders, balls and "
                          "springs");
    }
    const auto has_parts = [](const scene::BodyDescription& body) { return !body.parts.empty(); };
    if (std::any_of(bodies.begin(), bodies.end(), has_parts)) {
        return base::fail("a session has no bodies of several parts yet: leave out [[body.part]]");
    }
    if (scene.hands.count == 0) return base::fail("a session needs a hand; this scene has none");
    const auto index = found - bodies.begin();
    if (index > std::numeric_limits<number_on_the_wire>::max()) {
        return base::fail(fmt::format("the movable body of a session must be among the first {} "
                                      "of its scene; this is number {}",
                                      std::numeric_limits<number_on_the_wire>::max() + 1,
                                      index + 1));
    }
    return static_cast<scene::BodyId>(index);
}

} // namespace hapnet::peer
