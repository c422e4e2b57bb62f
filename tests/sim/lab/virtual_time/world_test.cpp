// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The timeline that players and links share.
#include "tests/sim/peer/core/score.hpp"

#include <gtest/gtest.h>

namespace hapnet::lab::virtual_time {
namespace {

using namespace std::chrono_literals;
using namespace base::literals;
using device::Task;
using sim::under;

TEST(VirtualWorld, JumpsFromTickToTickOfEitherSide)
{
    Setting setting = under(Task::t3, {});
    setting.players[0].phase = 300us;
    setting.players[1].phase = 800us;
    VirtualWorld world{setting};
    for (const auto since_start : {1300us, 1800us, 2300us, 2800us}) {
        world.step();
        EXPECT_EQ(world.now() - VirtualWorld::start, since_start);
    }
    EXPECT_EQ(world.side(0).stepped_at - VirtualWorld::start, 2300us);
    EXPECT_EQ(world.side(1).stepped_at - VirtualWorld::start, 2800us);
}

TEST(VirtualWorld, StampsADatagramWithTheTimeAtWhichItWasDueAndNotWithThatOfTheTick)
{
    Setting setting = under(Task::t3, {.delay = emulator::constant(40'300us)});
    setting.players[0].phase = 100us;
    setting.players[1].phase = 950us;
    setting.players[1].clock_ahead = -5s;
    VirtualWorld world{setting};
    sim::run_until_started(world);
    world.run_for(1s);
    for (const std::size_t side : {0U, 1U}) {
        const auto clock = world.side(side).peer().clock();
        ASSERT_TRUE(clock);
        EXPECT_EQ(clock->offset, side == 0 ? -5s : 5s);
        EXPECT_EQ(clock->uncertainty, 40'300us); // half the round trip, and no wait for a tick
    }
}

TEST(VirtualWorld, LetsNothingBeSeenBeforeItsDelayHasPassed)
{
    Setting setting = under(Task::p1, {.delay = emulator::constant(25'600us)});
    setting.players[1].phase = 500us;
    VirtualWorld world{setting};
    const auto touched = [&] { return world.side(0).last().touched.touching; };
    while (!touched()) world.step();
    const base::TimePoint first = world.now();
    while (!world.side(1).last().remote_touching) world.step();
    // Due 25.6 ms later, which is 0.1 ms after R's tick: seen at its next.
    EXPECT_EQ(world.now() - first, 26'500us);
}

TEST(VirtualWorld, ChangesTheLinksAtTheTimesOfTheProfileAlsoBetweenTicks)
{
    Setting setting = under(Task::t3, {.delay = emulator::constant(20ms)});
    emulator::Change change{.time = 2'000'300us, .ramp = {}, .up = {}, .down = {}};
    change.up.delay = emulator::constant(90ms);
    setting.profile.timeline = {change};
    VirtualWorld world{setting};
    const auto delay_of = [&](std::size_t from) {
        return std::get<emulator::ConstantLaw>(world.link(from, 1 - from).conditions().delay.law)
            .value;
    };
    world.run_for(2s);
    EXPECT_EQ(delay_of(0), 20ms);
    world.step();
    EXPECT_EQ(world.now() - VirtualWorld::start, 2'000'300us);
    EXPECT_EQ(delay_of(0), 90ms);
    EXPECT_EQ(delay_of(1), 20ms);
}

TEST(VirtualWorld, FollowsARampMillisecondByMillisecond)
{
    Setting setting = under(Task::t3, {.delay = emulator::constant(0ms)});
    emulator::Change change{.time = 1s, .ramp = 1s, .up = {}, .down = {}};
    change.down.delay = emulator::constant(100ms);
    setting.profile.timeline = {change};
    VirtualWorld world{setting};
    world.run_for(1500ms);
    const auto& law = world.link(1, 0).conditions().delay.law;
    EXPECT_EQ(std::get<emulator::ConstantLaw>(law).value, 50ms);
}

/// The hash of both sides of the first group, over 4 s.
std::uint64_t hash_of_the_first(VirtualWorld& world, const auto& disturb)
{
    sim::Hash hash;
    for (base::TimePoint next = world.now(); world.now() < VirtualWorld::start + 4s;) {
        world.step();
        disturb(world);
        if (world.now() < next + 1ms) continue;
        next += 1ms;
        hash.add(world, 0);
        hash.add(world, 1);
    }
    return hash.value();
}

TEST(VirtualWorld, KeepsGroupsFromEachOther)
{
    const Setting one = under(Task::t3, {.loss = {emulator::RandomLoss{20_percent}},
                                         .delay = emulator::constant(20ms),
                                         .jitter = emulator::uniform(10ms)});
    Setting other = under(Task::t1, {.delay = emulator::constant(70ms)});
    other.tick = 700us;
    other.players[0].phase = 123us;

    VirtualWorld alone{one};
    const auto nothing = [](VirtualWorld&) {};
    const std::uint64_t expected = hash_of_the_first(alone, nothing);

    const std::array both{one, other};
    VirtualWorld together{both};
    EXPECT_EQ(hash_of_the_first(together, nothing), expected);
    EXPECT_EQ(together.side(3).last().phase, peer::Phase::running);

    VirtualWorld troubled{both};
    const auto trouble = [](VirtualWorld& world) {
        const base::Duration at = world.now() - VirtualWorld::start;
        world.cut(2, 3, at > 1s && at < 2s);
        if (at > 3s && world.is_alive(2)) world.kill(2);
    };
    EXPECT_EQ(hash_of_the_first(troubled, trouble), expected);
    EXPECT_FALSE(troubled.is_alive(2));
}

TEST(VirtualWorld, GivesEqualPairsEqualBits)
{
    const Setting setting = under(Task::t3, {.delay = emulator::constant(20ms)});
    VirtualWorld world{std::array{setting, setting}};
    sim::run_until_started(world);
    world.run_for(1s);
    for (const std::size_t side : {0U, 1U}) {
        EXPECT_EQ(world.side(side).peer().position(), world.side(side + 2).peer().position());
        EXPECT_EQ(world.side(side).told(), world.side(side + 2).told());
    }
}

} // namespace
} // namespace hapnet::lab::virtual_time
