// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/description.hpp"

namespace hapnet::scene {

Description paper_scene()
{
    BodyDescription cube{.name = "cube"};
    cube.turning = Turning::locked;
    cube.drag_ns_per_m = 10.0;
    BodyDescription obstacle{.name = "static cube", .movable = false};
    obstacle.position = {{0.1147, 0.0, 0.030}};
    Description scene{.name = "paper"};
    scene.bodies = {cube, obstacle};
    scene.planes = {{.name = "platform", .offset_m = -0.020}};
    return scene;
}

} // namespace hapnet::scene
