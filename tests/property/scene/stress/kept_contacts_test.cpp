// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Data that a world keeps between ticks for speed must not change its results.
#include "proto/base/math.hpp"
#include "tests/support/scene/dice.hpp"
#include "tests/support/scene/random_play.hpp"

#include <array>
#include <gtest/gtest.h>
#include <variant>

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

/// A cube that slides to and fro between two hands, now and then poked, shifted or let go.
struct Pressed {
    explicit Pressed(std::uint64_t seed) : dice{base::Seed{seed}.stream("pressed")}
    {
        description = paper_scene();
        BodyDescription& cube = description.bodies[0];
        cube.turning = Turning::free;
        cube.locked = {};
        cube.drag_ns_per_m = 0.0;
        cube.material.friction = description.planes[0].material.friction = dice.between(0.0, 0.6);
        description.bodies[1].movable = dice.one_in(2);
        description.hands.count = 3;
        const bool is_aside = dice.one_in(3);
        for (double& place : places) place = is_aside ? dice.between(-0.012, 0.012) : 0.0;
        swing = dice.one_in(3) ? 0.0 : 5e-3;
        depth = dice.between(-2e-4, 1.5e-3);
    }

    void act(World& world, int tick)
    {
        for (const std::uint32_t hand : {0U, 1U}) {
            const double side = hand == 0 ? -1.0 : 1.0;
            const double t = 4e-3 * tick;
            HandInput input{{{side * (0.025 - depth) + swing * base::sin(t), places[hand], 0.0}},
                            {{4.0 * swing * base::cos(t), 0.0, 0.0}}};
            input.present = hand == 0 || tick % 500 < 400;
            input.gripping = tick % 700 > 650;
            std::ignore = world.set_hand(hand, input);
        }
        const glm::dvec3 aside = 1e-5 * dice.vector() * glm::dvec3{1.0, 0.0, 1.0};
        if (tick % 97 == 50) std::ignore = world.push(0, {1e3 * aside});
        if (tick % 131 == 60) std::ignore = world.shift(0, {aside});
        if (tick % 173 == 70) std::ignore = world.place(0, world.body(0));
        if (tick % 211 == 80) std::ignore = world.apply_impulse(0, 1e-3 * aside, world.position(0));
    }

    test::Dice dice;
    Description description;
    std::array<double, 2> places{};
    double swing = 0.0, depth = 0.0;
};

std::uint64_t steady_ticks(const World& world)
{
    return std::visit(
        [](const auto& stepper) -> std::uint64_t {
            if constexpr (requires { stepper.counts().steady_ticks; })
                return stepper.counts().steady_ticks;
            else
                return 0;
        },
        world.stepper());
}

TEST(KeptContacts, ATickInWhichEverythingGoesOnHasTheBitsOfOneThatBeginsFromNothing)
{
    constexpr int ticks = 800;
    std::uint64_t all = 0;
    for (std::uint64_t seed = 0; seed < 24; ++seed) {
        Pressed own{seed}, others{seed};
        auto world = World::freeze(own.description, {.sleeping = seed % 2 == 0});
        ASSERT_TRUE(world.has_value());
        World copied = *world;
        for (int tick = 0; tick < ticks; ++tick) {
            own.act(*world, tick);
            world->tick();
            World copy = copied;
            others.act(copy, tick);
            copy.tick();
            copied = std::move(copy);
            ASSERT_EQ(copied.hash(), world->hash()) << "seed " << seed << ", tick " << tick;
            EXPECT_EQ(copied.tick_cost().visits, world->tick_cost().visits);
            for (const std::uint32_t hand : {0U, 1U, 2U}) {
                const HandTouch& one = copied.touch(hand);
                const HandTouch& other = world->touch(hand);
                ASSERT_EQ(one.on_hand.value, other.on_hand.value) << "seed " << seed;
                ASSERT_EQ(one.on_hand_at_start.value, other.on_hand_at_start.value);
                ASSERT_EQ(one.on_body.value, other.on_body.value);
                ASSERT_EQ(one.depth_m, other.depth_m);
                ASSERT_EQ(one.touching, other.touching);
                ASSERT_EQ(one.body, other.body);
            }
        }
        all += steady_ticks(*world);
        EXPECT_EQ(steady_ticks(copied), 0U);
    }
    EXPECT_GT(all, 24U * ticks / 16); // at least a tenth continue in this way
}

} // namespace
} // namespace hapnet::scene
