// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/rhythm.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace hapnet::emulator::rhythm_test {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{1s};
constexpr Rhythm::Margin fixed{60us, 60us};
constexpr Rhythm::Margin learning{10us, 100us};

std::optional<base::TimePoint> sleep_of(const Rhythm::Plan& plan)
{
    return std::get<Rhythm::Sleep>(plan).until;
}

/// One sleep of a millisecond that ends `late`.
void sleep(Rhythm& rhythm, base::TimePoint from, base::Duration late)
{
    const auto plan = rhythm.plan(from + 1ms + rhythm.margin(), from);
    rhythm.on_wake_up(plan, {from, *sleep_of(plan) + late, false});
}

TEST(Rhythm, SleepsForADatagramAloneWhenThereIsNoDeadline)
{
    const Rhythm rhythm{fixed, start};
    EXPECT_EQ(sleep_of(rhythm.plan(std::nullopt, start)), std::nullopt);
}

TEST(Rhythm, SleepsUntilTheMarginBeforeTheDeadlineAndThenWatches)
{
    const Rhythm rhythm{fixed, start};
    const auto deadline = start + 1ms;
    EXPECT_EQ(sleep_of(rhythm.plan(deadline, start)), deadline - 60us);
    EXPECT_EQ(sleep_of(rhythm.plan(deadline, deadline - 60us - 1ns)), deadline - 60us);
    EXPECT_TRUE(std::holds_alternative<Rhythm::Watch>(rhythm.plan(deadline, deadline - 60us)));
    EXPECT_TRUE(std::holds_alternative<Rhythm::Watch>(rhythm.plan(deadline, deadline + 1ms)));
}

TEST(Rhythm, WithoutAMarginSleepsToTheDeadlineItself)
{
    const Rhythm rhythm{{0us, 0us}, start};
    EXPECT_EQ(sleep_of(rhythm.plan(start + 1ns, start)), start + 1ns);
    EXPECT_TRUE(std::holds_alternative<Rhythm::Watch>(rhythm.plan(start, start)));
}

TEST(Rhythm, RestsForHalfAPerCentOfTheTimeThatItHasBeenAwake)
{
    const Rhythm rhythm{fixed, start};
    const auto overdue = start; // a flood: something is always due
    EXPECT_TRUE(std::holds_alternative<Rhythm::Watch>(rhythm.plan(overdue, start + 10ms)));
    const auto plan = rhythm.plan(overdue, start + 10ms + 1ns);
    ASSERT_TRUE(std::holds_alternative<Rhythm::Rest>(plan));
    EXPECT_EQ(std::get<Rhythm::Rest>(plan).until, start + 10ms + 1ns + 50us);
}

TEST(Rhythm, ARestOrASleepCountsAsOneFromHalfARestOn)
{
    const auto tired = start + 10ms + 1ns;
    const auto is_rested_after = [&](base::Duration slept) {
        Rhythm rhythm{fixed, start};
        const auto plan = rhythm.plan(start, tired);
        rhythm.on_wake_up(plan, {tired, tired + slept, false});
        return std::holds_alternative<Rhythm::Watch>(rhythm.plan(start, tired + slept));
    };
    EXPECT_TRUE(is_rested_after(50us));
    EXPECT_TRUE(is_rested_after(25us));
    EXPECT_FALSE(is_rested_after(25us - 1ns)); // datagrams came at once: no sleep at all
}

bool is_warm_up(const Rhythm::Plan& plan) { return std::get<Rhythm::Watch>(plan).warm_up; }

TEST(Rhythm, WarmsUpOnceAfterASleepWhenThereIsTimeForIt)
{
    Rhythm rhythm{fixed, start};
    EXPECT_FALSE(is_warm_up(rhythm.plan(start + 60us, start))); // it has not slept
    sleep(rhythm, start, 5us);
    const auto deadline = start + 1ms + 60us;
    EXPECT_TRUE(is_warm_up(rhythm.plan(deadline, deadline - 15us)));
    EXPECT_FALSE(is_warm_up(rhythm.plan(deadline, deadline - 15us + 1ns)));
    rhythm.on_warm_up();
    EXPECT_FALSE(is_warm_up(rhythm.plan(deadline, deadline - 15us)));
}

TEST(Rhythm, WidensTheMarginWhenWakeUpsAreLaterAndNarrowsItSlowly)
{
    Rhythm rhythm{learning, start};
    const auto at_first = rhythm.margin();
    sleep(rhythm, start, at_first - 15us + 1ns);
    const auto grown = rhythm.margin() - at_first;
    EXPECT_GT(grown, 1us);
    sleep(rhythm, start + 2ms, 0us);
    EXPECT_LT(rhythm.margin(), at_first + grown);
    EXPECT_GT(rhythm.margin(), at_first + grown - grown / 20);
}

TEST(Rhythm, KeepsTheMarginWithinItsLimits)
{
    Rhythm rhythm{{30us, 100us}, start};
    auto now = start;
    for (int i = 0; i < 10'000; ++i) sleep(rhythm, now += 2ms, 5us);
    EXPECT_EQ(rhythm.margin(), 30us);
    for (int i = 0; i < 10'000; ++i) sleep(rhythm, now += 2ms, 1ms);
    EXPECT_EQ(rhythm.margin(), 100us);
}

TEST(Rhythm, SettlesWhereAllButAFewWakeUpsLeaveTimeForAWarmUp)
{
    Rhythm rhythm{learning, start};
    auto now = start;
    int later = 0;
    constexpr int settling = 5000;
    constexpr int counted = 20'000;
    for (int i = 0; i < settling + counted; ++i) {
        const auto late = std::chrono::microseconds{(i * 37) % 50}; // 0 to 49 us, all as often
        if (i >= settling && late + 15us > rhythm.margin()) ++later;
        sleep(rhythm, now += 2ms, late);
    }
    EXPECT_GE(rhythm.margin(), 49us + 15us - 2us); // the 99th percentile is 49 us
    EXPECT_LE(rhythm.margin(), 49us + 15us + 2us);
    EXPECT_LE(later, counted / 50);
}

TEST(Rhythm, LearnsNothingFromASleepThatADatagramEnded)
{
    Rhythm rhythm{learning, start};
    const auto before = rhythm.margin();
    const auto plan = rhythm.plan(start + 1ms, start);
    rhythm.on_wake_up(plan, {start, start + 2ms, true});
    rhythm.on_wake_up(plan, {start, start + 10us, false}); // a signal
    rhythm.on_wake_up(Rhythm::Sleep{}, {start, start + 2ms, false});
    rhythm.on_wake_up(Rhythm::Rest{start}, {start, start + 2ms, false});
    EXPECT_EQ(rhythm.margin(), before);
}

} // namespace
} // namespace hapnet::emulator::rhythm_test
