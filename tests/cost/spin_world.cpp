// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// spin_world PROFILE TICKS: a world with every tick compiled in, of which the scene chooses one.
#include "scene/world.hpp"
#include "tests/cost/spin.hpp"

#include <cstdlib>

int main(int argc, char** argv)
{
    namespace scene = hapnet::scene;
    if (argc != 3) return 2;
    auto world = scene::World::freeze(hapnet::cost::scene_for(argv[1]), {.sleeping = true});
    if (!world || name_of(world->stepper_kind()) != argv[1]) return 2;
    for (const std::uint32_t index : {0U, 1U}) {
        if (world->set_hand(index, hapnet::cost::hand(index))) return 2;
    }
    for (long left = std::atol(argv[2]); left > 0; --left) world->tick();
    return 0;
}
