// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// What a world keeps from tick to tick to be fast does not show in what it does.
#include "tests/support/scene/random_play.hpp"

#include <gtest/gtest.h>

namespace hapnet::scene {
namespace {

constexpr std::uint64_t plays = 150;

test::RandomPlay small_play(std::uint64_t seed)
{
    return test::random_play(seed, {.bodies_max = 5, .ticks_min = 30, .ticks_max = 80});
}

TEST(KeptContacts, AWorldThatIsCopiedBeforeEveryTickHasNothingKeptAndTheSameBits)
{
    for (std::uint64_t seed = 0; seed < plays; ++seed) {
        const test::RandomPlay play = small_play(seed);
        auto world = World::freeze(play.description, play.options);
        ASSERT_TRUE(world.has_value());
        World copied = *world;
        for (const test::TickInputs& inputs : play.ticks) {
            test::feed(*world, inputs);
            world->tick();
            World copy = copied;
            test::feed(copy, inputs);
            copy.tick();
            copied = std::move(copy);
            ASSERT_EQ(copied.hash(), world->hash()) << "seed " << seed;
        }
    }
}

TEST(KeptContacts, AWorldThatIsTakenBackKeepsNothingOfWhatItDidMeanwhile)
{
    for (std::uint64_t seed = 0; seed < plays; ++seed) {
        const test::RandomPlay play = small_play(seed);
        auto world = World::freeze(play.description, play.options);
        ASSERT_TRUE(world.has_value());
        World back = *world;
        int tick = 0;
        for (const test::TickInputs& inputs : play.ticks) {
            if (++tick % 3 == 0) {
                const World::Snapshot here = back.snapshot();
                for (int ahead = 0; ahead < 4; ++ahead) {
                    for (BodyId id = 0; id < play.description.bodies.size(); ++id) {
                        if (play.description.bodies[id].movable)
                            std::ignore = back.push(id, {{0.3, -1.0, 0.2}});
                    }
                    back.tick();
                }
                back.restore(here);
            }
            test::feed(*world, inputs);
            world->tick();
            test::feed(back, inputs);
            back.tick();
            ASSERT_EQ(back.hash(), world->hash()) << "seed " << seed;
        }
    }
}

} // namespace
} // namespace hapnet::scene
