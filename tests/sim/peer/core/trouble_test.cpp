// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Sessions in which a part dies, and comes back.
#include "tests/sim/peer/core/score.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace hapnet::sim {
namespace {

using namespace std::chrono_literals;
using namespace base::literals;
using device::Task;
using peer::Event;
using peer::Phase;

constexpr base::Duration delay = 40ms;

bool told(const Player& side, Event event)
{
    return std::find(side.events.begin(), side.events.end(), event) != side.events.end();
}

/// A running squeeze that both hands feel.
World squeezing()
{
    World world{under(Task::t3, {.delay = emulator::constant(delay)})};
    run_until_started(world);
    world.run_for(3s);
    for (const std::size_t i : {0U, 1U}) {
        EXPECT_GT(base::norm(world.side(i).told()), 0.1) << i;
    }
    return world;
}

/// Expects that the force holds for 250 ms after the last arrival, and is zero after 300 ms.
void expect_fade(World& world, std::size_t side)
{
    world.run_for(delay + 250ms - 2ms);
    EXPECT_TRUE(world.side(side).last().permitted);
    EXPECT_FALSE(told(world.side(side), Event::lost));
    world.run_for(50ms + 4ms);
    EXPECT_EQ(world.side(side).told(), base::Force{});
    EXPECT_TRUE(told(world.side(side), Event::lost));
    for (int ms = 0; ms < 1000; ++ms) {
        world.step();
        ASSERT_EQ(world.side(side).told(), base::Force{}) << ms;
    }
    EXPECT_EQ(world.side(side).last().phase, Phase::running); // and it continues
}

class Death : public testing::TestWithParam<std::size_t> {};

TEST_P(Death, OfASideFadesTheForceOfTheOtherToZeroWithin300Ms)
{
    World world = squeezing();
    world.kill(GetParam());
    expect_fade(world, 1 - GetParam());
}

TEST_P(Death, OfASideIsOverWhenItComesBackAndItTakesTheCubeOfTheOneThatStayed)
{
    const std::size_t restarted = GetParam();
    const std::size_t stayed = 1 - restarted;
    World world = squeezing();
    world.kill(restarted);
    world.run_for(2s);
    const base::TimePoint start = world.side(stayed).peer().session()->start;
    const auto sequence = world.side(stayed).last().sequence;
    world.revive(restarted);
    int ms = 0;
    while (world.side(restarted).last().touched.touching ||
           !world.side(restarted).last().permitted) {
        world.step();
        // Until it has received the cube it touches nothing. Then it has the cube where the other
        // has it, up to the motion meanwhile.
        ASSERT_LT(++ms, 1000);
    }
    EXPECT_LT(discrepancy_x(world), 0.33 * base::to_seconds(2 * delay));
    world.run_for(3s);
    EXPECT_TRUE(told(world.side(restarted), Event::joined));
    EXPECT_TRUE(told(world.side(stayed), Event::restarted));
    EXPECT_EQ(world.side(stayed).peer().session()->start, start);
    EXPECT_EQ(world.side(restarted).peer().session()->start, start);
    EXPECT_LT(world.side(stayed).last().sequence, sequence); // a new session, counted from 1
    for (const std::size_t i : {0U, 1U}) {
        // Both may feel again. Whether they find the cube does not matter: scripted hands do not
        // look for a dropped cube.
        EXPECT_TRUE(world.side(i).last().permitted) << i;
        EXPECT_EQ(world.side(i).last().phase, Phase::running) << i;
    }
    while (world.side(0).last().phase == Phase::running) world.step();
    world.run_for(2s);
    EXPECT_LE(discrepancy_x(world), 0.1e-3);
}

INSTANTIATE_TEST_SUITE_P(OfSide, Death, testing::Values(0, 1));

TEST(Cut, FadesBothForcesToZeroAndHeals)
{
    World world = squeezing();
    world.cut(0, 1, true);
    expect_fade(world, 0);
    EXPECT_EQ(world.side(1).told(), base::Force{});
    EXPECT_TRUE(told(world.side(1), Event::lost));
    const auto session = world.side(0).peer().session()->number;
    world.cut(0, 1, false);
    world.run_for(delay + 2ms);
    for (const std::size_t i : {0U, 1U}) {
        EXPECT_TRUE(told(world.side(i), Event::back)) << i;
        EXPECT_FALSE(told(world.side(i), Event::restarted)) << i;
        EXPECT_LT(base::norm(world.side(i).told()), 0.1) << i; // ramps in, no kick
    }
    world.run_for(1500ms);
    for (const std::size_t i : {0U, 1U}) {
        EXPECT_GT(base::norm(world.side(i).told()), 0.1) << i;
        EXPECT_EQ(world.side(i).peer().session()->number, session) << i;
    }
    while (world.side(0).last().phase == Phase::running) world.step();
    world.run_for(2s);
    EXPECT_LE(discrepancy_x(world), 0.1e-3);
}

TEST(Cut, BeforeTheStartOnlyDelaysIt)
{
    World world{under(Task::t3, {.delay = emulator::constant(delay)})};
    world.cut(0, 1, true);
    world.run_for(5s);
    EXPECT_EQ(world.side(0).last().phase, Phase::waiting);
    world.cut(0, 1, false);
    world.run_for(2s);
    EXPECT_EQ(world.side(0).last().phase, Phase::running);
    EXPECT_EQ(world.side(1).last().phase, Phase::running);
}

TEST(Path, ThatIsSecondsSlowerOneWayKeepsStatesUsable)
{
    Setting setting = under(Task::t3, {.delay = emulator::constant(50ms)});
    setting.profile.path.up.delay = emulator::constant(4s);
    World world{setting};
    world.run_for(20s);
    for (const std::size_t i : {0U, 1U}) {
        EXPECT_TRUE(world.side(i).last().permitted) << i;
        EXPECT_EQ(world.side(i).peer().counters().implausible, 0U) << i;
    }
}

TEST(ClockJump, IsDoubtedAtOnceAndToldWhenItIsSure)
{
    World world{under(Task::t3, {.delay = emulator::constant(delay)})};
    run_until_started(world);
    world.run_for(5s);
    world.side(1).clock_ahead = 400ms;
    world.run_for(delay - 2ms);
    for (const std::size_t i : {0U, 1U}) EXPECT_TRUE(world.side(i).peer().clock()) << i;
    world.run_for(4ms); // its new stamps have come
    EXPECT_FALSE(world.side(0).peer().clock());
    world.run_for(delay); // and echoes of them have gone back
    for (const std::size_t i : {0U, 1U}) EXPECT_FALSE(world.side(i).peer().clock()) << i;
    world.run_for(10s);
    const std::array<base::Duration, 2> ahead{400ms, -400ms};
    for (const std::size_t i : {0U, 1U}) {
        const Player& side = world.side(i);
        ASSERT_TRUE(side.peer().clock()) << i;
        EXPECT_EQ(side.peer().clock()->offset, ahead.at(i)) << i;
        EXPECT_EQ(std::count(side.events.begin(), side.events.end(), Event::clock_jumped), 1) << i;
    }
}

TEST(Goodbye, FadesTheOthersForceWithin50MsOfItsArrival)
{
    World world = squeezing();
    world.side(0).peer().leave(wire::ByeReason::interrupted);
    world.run_for(delay + 50ms + 4ms);
    EXPECT_TRUE(told(world.side(1), Event::left));
    EXPECT_EQ(world.side(1).told(), base::Force{});
    EXPECT_EQ(world.side(0).told(), base::Force{});
    EXPECT_TRUE(world.side(0).peer().finished());
}

} // namespace
} // namespace hapnet::sim
