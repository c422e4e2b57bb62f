// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// A hand pushes the cube of the paper's scene by 20 mm, in one second of virtual time.
#include <cstdio>
#include <hapnet/scene/text/text.hpp>
#include <hapnet/scene/world.hpp>

int main()
{
    using namespace hapnet;
    const auto no_file = [](const std::string& name) { return base::Result<std::string>{name}; };
    auto world = scene::World::freeze(scene::load_scene("paper", no_file).value()).value();
    for (int tick = 0; tick <= 1000; ++tick) {
        // Half the cube's edge and the hand's radius add up to 25 mm.
        const double hip_m = -0.025 + 20e-6 * tick;
        world.set_hand(0, {.position = {{hip_m, 0.0, 0.0}}, .velocity = {{0.02, 0.0, 0.0}}});
        world.tick();
        if (tick % 250 != 0) continue;
        std::printf("%4d ms  cube at %6.3f mm  hand feels %6.3f N\n", tick,
                    1e3 * world.position(0).x(), world.touch(0).on_hand.x());
    }
}
