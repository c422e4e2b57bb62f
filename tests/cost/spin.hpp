// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/state.hpp"

#include <string_view>

namespace hapnet::cost {

// The work of both programs, which differ only in the code compiled into them: two hands press a
// cube from both sides, one of them a little deeper, so that it slides away between them.

/// Returns a scene that needs just the profile of that name.
[[nodiscard]] inline scene::Description scene_for(std::string_view kind)
{
    scene::Description description = scene::paper_scene();
    if (kind != "sliding") {
        description.bodies[0].locked = {};
        description.bodies[0].material.friction = 0.3;
        description.planes[0].material.friction = 0.3;
    }
    if (kind == "lone" || kind == "few") {
        description.bodies[0].turning = scene::Turning::free;
        description.bodies[0].drag_ns_per_m = 0.0;
    }
    if (kind == "few") description.bodies[1].movable = true;
    return description;
}

[[nodiscard]] inline scene::HandInput hand(std::uint32_t index)
{
    const double side = index == 0 ? -1.0 : 1.0;
    return {.position = {{side * 0.0245 - 1e-4, 0.0, 0.0}}, .velocity = {}};
}

} // namespace hapnet::cost
