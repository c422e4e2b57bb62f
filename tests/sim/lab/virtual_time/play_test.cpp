// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The traces that sessions in virtual time leave behind.
#include "lab/virtual_time/play.hpp"
#include "tests/sim/peer/core/score.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>
#include <utility>
#include <vector>

namespace hapnet::lab::virtual_time {
namespace {

using namespace std::chrono_literals;
using namespace base::literals;
using device::Task;
using sim::under;

/// Loss, jitter and reordering under a squeeze; 5 s hands on.
Setting troubled()
{
    Setting setting = under(Task::t3, {.loss = {emulator::RandomLoss{30_percent}},
                                       .delay = emulator::constant(40ms),
                                       .jitter = emulator::uniform(15ms),
                                       .order = emulator::Order::free});
    setting.length = 8s;
    return setting;
}

std::uint64_t hash_of(const Trace& trace)
{
    sim::Hash hash;
    for (const auto& side : trace.sides) {
        for (const Sample& sample : side) {
            for (const auto& v : {sample.body.value, sample.hip.value, sample.on_hand.value}) {
                for (const int axis : {0, 1, 2}) hash.add(v[axis]);
            }
        }
    }
    return hash.value();
}

TEST(Play, OfOneSettingGivesTheSameBitsWhateverThePhases)
{
    for (const base::Duration phase : {0us, 250us, 999us}) {
        Setting setting = troubled();
        setting.players[1].phase = phase;
        const auto first = play(setting);
        const auto second = play(setting);
        ASSERT_TRUE(first && second);
        EXPECT_GE(first->sides[0].size(), 4990U) << "of 5000 ticks with hands on";
        EXPECT_EQ(first->sides[0].size(), first->sides[1].size());
        EXPECT_EQ(hash_of(*first), hash_of(*second)) << phase.count();
        setting.seed = base::Seed{43};
        EXPECT_NE(hash_of(*first), hash_of(play(setting).value())) << phase.count();
    }
}

using Ticks = std::shared_ptr<const std::vector<base::Duration>>;

/// The ticks of a loop that ticks evenly from `first` on, for more than a session of 8 s.
Ticks even_ticks(base::Duration first)
{
    std::vector<base::Duration> ticks;
    for (base::Duration tick = first; tick <= 9s; tick += 1ms) ticks.push_back(tick);
    return std::make_shared<const std::vector<base::Duration>>(std::move(ticks));
}

/// As even_ticks(), without the ticks missed from `at` on.
Ticks ticks_without(base::Duration at, base::Duration missed)
{
    const Ticks all = even_ticks(0ms);
    std::vector<base::Duration> ticks;
    for (const base::Duration tick : *all)
        if (tick < at || tick >= at + missed) ticks.push_back(tick);
    return std::make_shared<const std::vector<base::Duration>>(std::move(ticks));
}

TEST(Play, OfGivenTicksThatAreEvenGivesTheSameBitsAsWithout)
{
    // Without jitter both sides know exactly when the session starts, from which ticks count.
    Setting setting = under(Task::t3, {.delay = emulator::constant(40ms)});
    setting.length = 8s;
    const auto even = play(setting);
    ASSERT_TRUE(even);
    setting.players[0].ticks = setting.players[1].ticks = even_ticks(even->begin);
    const auto given = play(setting);
    ASSERT_TRUE(given);
    EXPECT_EQ(given->sides[0].size(), even->sides[0].size());
    EXPECT_EQ(hash_of(*given), hash_of(*even));
}

TEST(Play, OfALoopThatStoodStillTakesTheForceFromItsHandAsTheDaemonDoes)
{
    const auto force_after = [](base::Duration missed) {
        Setting setting = under(Task::t3, {});
        setting.length = 8s;
        setting.players[1].ticks = ticks_without(3s, missed);
        const auto trace = play(setting);
        EXPECT_TRUE(trace);
        EXPECT_GE(trace->sides[1].size(), 4990U) << "time without ticks is bridged";
        double newtons = 0.0; // the most in the tenth of a second that follows
        for (std::size_t i = 3030; i < 3130; ++i)
            newtons = std::max(newtons, norm(trace->sides[1][i].on_hand));
        return newtons;
    };
    const double undisturbed = force_after(0ms);
    EXPECT_GT(undisturbed, 0.3) << "it is pressing";
    EXPECT_GT(force_after(19ms), 0.8 * undisturbed);
    EXPECT_LT(force_after(22ms), 0.5 * undisturbed) << "after 20 ms the governor begins at zero";
}

TEST(Play, RefusesTicksThatDoNotFollowOneAnother)
{
    Setting setting = troubled();
    setting.players[0].ticks =
        std::make_shared<const std::vector<base::Duration>>(std::vector<base::Duration>{2ms, 2ms});
    EXPECT_EQ(play(setting).error().message, "the ticks of a player must follow one another");
}

TEST(Play, OfEqualPhasesGivesWhatBothSidesDidAtTheirTicks)
{
    const Setting setting = troubled();
    const auto trace = play(setting);
    ASSERT_TRUE(trace);
    VirtualWorld world{setting};
    sim::run_until_started(world);
    for (std::size_t i = 0; i < trace->sides[0].size(); ++i, world.step()) {
        for (const std::size_t side : {0U, 1U}) {
            ASSERT_EQ(trace->sides[side][i].body, world.side(side).peer().body().position) << i;
            ASSERT_EQ(trace->sides[side][i].on_hand, world.side(side).told()) << i;
        }
    }
    const bool both_run = world.side(0).last().phase == peer::Phase::running &&
                          world.side(1).last().phase == peer::Phase::running;
    EXPECT_FALSE(both_run) << "nothing is left out at the end";
    EXPECT_EQ(trace->task, Task::t3);
}

TEST(Play, TakesTheRightSideAtTheLeftOnesTimes)
{
    Setting setting = under(Task::p1, {.delay = emulator::constant(160ms)});
    setting.length = 6s;
    setting.players[1].phase = 750us;
    const auto trace = play(setting);
    ASSERT_TRUE(trace);
    VirtualWorld world{setting};
    sim::run_until_started(world); // R's tick at the start, and then L's first
    ASSERT_EQ(world.now(), world.side(0).peer().session()->start + 250us);
    Sample before = world.side(1).sample();
    for (std::size_t i = 0; i < trace->sides[0].size(); ++i) {
        const Sample left = world.side(0).sample();
        world.step(); // R's
        const Sample after = world.side(1).sample();
        world.step();
        ASSERT_EQ(trace->sides[0][i].body, left.body) << i;
        ASSERT_EQ(trace->sides[1][i].body, between(before, after, 0.25).body) << i;
        before = after;
    }
    EXPECT_EQ(trace->begin, 250us);
    EXPECT_NEAR(trace->overlap, 1.0, 0.001);
}

TEST(Play, OfASessionThatCannotBeginGivesAnEmptyTrace)
{
    Setting setting = troubled();
    setting.profile.path.up.loss = {emulator::RandomLoss{100_percent}};
    const auto trace = play(setting);
    ASSERT_TRUE(trace);
    EXPECT_TRUE(trace->sides[0].empty());
    EXPECT_EQ(trace->overlap, 0.0);
    EXPECT_LT(trace->simulated, 61s);
}

TEST(Play, OfASessionThatOneSideHearsOfLateBeginsWithThatSide)
{
    Setting setting = troubled(); // from R nothing is lost, from L everything in the first 3 s
    setting.profile.path.up.loss = {emulator::Outage{{{100ms, 3000ms}}}};
    const auto trace = play(setting);
    ASSERT_TRUE(trace);
    ASSERT_FALSE(trace->sides[0].empty());
    EXPECT_GT(trace->begin, 1500ms);
    EXPECT_NEAR(trace->overlap, 1.0 - base::to_seconds(trace->begin) / 5.0, 0.001);
}

TEST(Play, OfOneBodyThatCannotTurnSaysHowItSettlesWhereThatIsAsked)
{
    Setting setting = under(Task::t3, {.delay = emulator::constant(80ms)});
    setting.length = 6s;
    const auto usual = play(setting);
    const auto settled = play(setting, nullptr, PlaysOn::always);
    ASSERT_TRUE(usual && settled);
    EXPECT_TRUE(usual->settled.empty());
    ASSERT_EQ(settled->settled.size(), 1U);
    EXPECT_LT(settled->settled[0].metres, 1e-5) << "all let go two seconds ago";
    EXPECT_GT(settled->simulated, usual->simulated + 2s);
    EXPECT_EQ(settled->sides[0].size(), usual->sides[0].size()) << "hands off is not scored";
}

TEST(Play, EndsWhenItIsStopped)
{
    const std::atomic<bool> stop{true};
    EXPECT_FALSE(play(troubled(), &stop));
}

TEST(Play, RefusesWhatCannotBePlayed)
{
    const auto refuses = [](auto&& change) {
        Setting setting = troubled();
        change(setting);
        return !play(setting).has_value();
    };
    EXPECT_TRUE(refuses([](Setting& s) { s.tick = 1us; }));
    EXPECT_TRUE(refuses([](Setting& s) { s.players[0].phase = s.tick; }));
    EXPECT_TRUE(refuses([](Setting& s) { s.players[1].phase = -1us; }));
    EXPECT_TRUE(refuses([](Setting& s) { s.length = 0s; }));
    EXPECT_TRUE(refuses([](Setting& s) { s.scene.bodies.clear(); }));
    EXPECT_FALSE(refuses([](Setting& s) { s.tick = 4ms; }));
}

TEST(Play, LosesNoDatagramThatTheEmulatorWouldKeep)
{
    Setting setting = under(Task::p1, {.delay = emulator::constant(5s)});
    setting.length = 40s;
    VirtualWorld small{setting};
    small.run_for(35s);
    const auto full = [](const VirtualWorld& world) {
        return world.link(0, 1).statistics().dropped[emulator::DropCause::queue_full];
    };
    EXPECT_GT(full(small), 0U) << "5 s of states are more than it holds";
    const auto trace = play(setting);
    ASSERT_TRUE(trace);
    // B's cube is A's of 5 s ago, as long as no message is missing.
    const auto &left = trace->sides[0], &right = trace->sides[1];
    ASSERT_GT(left.size(), 20'000U);
    for (std::size_t i = 10'000; i < left.size(); ++i) {
        ASSERT_NEAR(right[i].body.x(), left[i - 5000].body.x(), 1e-8) << i; // singles on the wire
    }
}

} // namespace
} // namespace hapnet::lab::virtual_time
