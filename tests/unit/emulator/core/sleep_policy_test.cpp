// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/sleep_policy.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace hapnet::emulator::sleep_policy_test {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{1s};
constexpr SleepPolicy::Margin fixed{60us, 60us};
constexpr SleepPolicy::Margin learning{10us, 100us};

std::optional<base::TimePoint> sleep_of(const SleepPolicy::Plan& plan)
{
    return std::get<SleepPolicy::Sleep>(plan).until;
}

/// Makes one sleep of a millisecond that ends `late`.
void sleep(SleepPolicy& policy, base::TimePoint from, base::Duration late)
{
    const auto plan = policy.plan(from + 1ms + policy.margin(), from);
    policy.on_wake_up(plan, {from, *sleep_of(plan) + late, false});
}

TEST(SleepPolicy, SleepsForADatagramAloneWhenThereIsNoDeadline)
{
    const SleepPolicy policy{fixed, start};
    EXPECT_EQ(sleep_of(policy.plan(std::nullopt, start)), std::nullopt);
}

TEST(SleepPolicy, SleepsUntilTheMarginBeforeTheDeadlineAndThenWatches)
{
    const SleepPolicy policy{fixed, start};
    const auto deadline = start + 1ms;
    EXPECT_EQ(sleep_of(policy.plan(deadline, start)), deadline - 60us);
    EXPECT_EQ(sleep_of(policy.plan(deadline, deadline - 60us - 1ns)), deadline - 60us);
    EXPECT_TRUE(std::holds_alternative<SleepPolicy::Spin>(policy.plan(deadline, deadline - 60us)));
    EXPECT_TRUE(std::holds_alternative<SleepPolicy::Spin>(policy.plan(deadline, deadline + 1ms)));
}

TEST(SleepPolicy, WithoutAMarginSleepsToTheDeadlineItself)
{
    const SleepPolicy policy{{0us, 0us}, start};
    EXPECT_EQ(sleep_of(policy.plan(start + 1ns, start)), start + 1ns);
    EXPECT_TRUE(std::holds_alternative<SleepPolicy::Spin>(policy.plan(start, start)));
}

TEST(SleepPolicy, RestsForHalfAPerCentOfTheTimeThatItHasBeenAwake)
{
    const SleepPolicy policy{fixed, start};
    const auto overdue = start; // a flood: something is always due
    EXPECT_TRUE(std::holds_alternative<SleepPolicy::Spin>(policy.plan(overdue, start + 10ms)));
    const auto plan = policy.plan(overdue, start + 10ms + 1ns);
    ASSERT_TRUE(std::holds_alternative<SleepPolicy::Yield>(plan));
    EXPECT_EQ(std::get<SleepPolicy::Yield>(plan).until, start + 10ms + 1ns + 50us);
}

TEST(SleepPolicy, ARestOrASleepCountsAsOneFromHalfARestOn)
{
    const auto tired = start + 10ms + 1ns;
    const auto is_rested_after = [&](base::Duration slept) {
        SleepPolicy policy{fixed, start};
        const auto plan = policy.plan(start, tired);
        policy.on_wake_up(plan, {tired, tired + slept, false});
        return std::holds_alternative<SleepPolicy::Spin>(policy.plan(start, tired + slept));
    };
    EXPECT_TRUE(is_rested_after(50us));
    EXPECT_TRUE(is_rested_after(25us));
    EXPECT_FALSE(is_rested_after(25us - 1ns)); // datagrams came at once: no sleep at all
}

bool is_warm_up(const SleepPolicy::Plan& plan) { return std::get<SleepPolicy::Spin>(plan).warm_up; }

TEST(SleepPolicy, WarmsUpOnceAfterASleepWhenThereIsTimeForIt)
{
    SleepPolicy policy{fixed, start};
    EXPECT_FALSE(is_warm_up(policy.plan(start + 60us, start))); // it has not slept
    sleep(policy, start, 5us);
    const auto deadline = start + 1ms + 60us;
    EXPECT_TRUE(is_warm_up(policy.plan(deadline, deadline - 15us)));
    EXPECT_FALSE(is_warm_up(policy.plan(deadline, deadline - 15us + 1ns)));
    policy.on_warm_up();
    EXPECT_FALSE(is_warm_up(policy.plan(deadline, deadline - 15us)));
}

TEST(SleepPolicy, WidensTheMarginWhenWakeUpsAreLaterAndNarrowsItSlowly)
{
    SleepPolicy policy{learning, start};
    const auto at_first = policy.margin();
    sleep(policy, start, at_first - 15us + 1ns);
    const auto grown = policy.margin() - at_first;
    EXPECT_GT(grown, 1us);
    sleep(policy, start + 2ms, 0us);
    EXPECT_LT(policy.margin(), at_first + grown);
    EXPECT_GT(policy.margin(), at_first + grown - grown / 20);
}

TEST(SleepPolicy, KeepsTheMarginWithinItsLimits)
{
    SleepPolicy policy{{30us, 100us}, start};
    auto now = start;
    for (int i = 0; i < 10'000; ++i) sleep(policy, now += 2ms, 5us);
    EXPECT_EQ(policy.margin(), 30us);
    for (int i = 0; i < 10'000; ++i) sleep(policy, now += 2ms, 1ms);
    EXPECT_EQ(policy.margin(), 100us);
}

TEST(SleepPolicy, SettlesWhereAllButAFewWakeUpsLeaveTimeForAWarmUp)
{
    SleepPolicy policy{learning, start};
    auto now = start;
    int later = 0;
    constexpr int settling = 5000;
    constexpr int counted = 20'000;
    for (int i = 0; i < settling + counted; ++i) {
        const auto late = std::chrono::microseconds{(i * 37) % 50}; // 0 to 49 us, equally often
        if (i >= settling && late + 15us > policy.margin()) ++later;
        sleep(policy, now += 2ms, late);
    }
    EXPECT_GE(policy.margin(), 49us + 15us - 2us); // the 99th percentile is 49 us
    EXPECT_LE(policy.margin(), 49us + 15us + 2us);
    EXPECT_LE(later, counted / 50);
}

/// One second of a stream whose datagrams are due every `spacing`, each for `work` of processor
/// time: the time of that second in which the thread is awake. Sleeps end on time.
base::Duration awake_in_a_second(SleepPolicy policy, base::Duration spacing, base::Duration work)
{
    auto now = start;
    base::Duration used{};
    base::Duration used_before{};
    const auto be_awake = [&](base::Duration time) {
        now += time;
        used += time;
    };
    auto deadline = start + spacing;
    while (now < start + 2s) {
        if (now < start + 1s) used_before = used; // the saved budget may be spent first
        if (policy.wants_usage(now)) policy.on_usage(used, now);
        const auto plan = policy.plan(deadline, now);
        if (const auto* sleep = std::get_if<SleepPolicy::Sleep>(&plan)) {
            const auto slept = now;
            now = std::max(now, *sleep->until);
            policy.on_wake_up(plan, {slept, now, false});
        } else if (const auto* yield = std::get_if<SleepPolicy::Yield>(&plan)) {
            const auto slept = now;
            now = yield->until;
            policy.on_wake_up(plan, {slept, now, false});
        } else if (now < deadline) {
            be_awake(1us);
        }
        if (now < deadline) continue;
        be_awake(work);
        deadline += spacing;
    }
    return used - used_before;
}

TEST(SleepPolicy, WatchesNoMoreThanLeavesOtherProgramsThreeTenthsOfACore)
{
    for (const auto spacing : {40us, 60us, 70us, 100us, 200us, 1000us}) {
        const auto awake = awake_in_a_second(SleepPolicy{fixed, start}, spacing, 10us);
        EXPECT_LE(awake, 710ms) << spacing.count();
        EXPECT_GE(awake, std::min<base::Duration>(680ms, 1s / spacing * 69us)) << spacing.count();
    }
}

TEST(SleepPolicy, SleepsToTheDeadlineWhereTheWorkAloneTakesMoreThanTheBudget)
{
    const auto awake = awake_in_a_second(SleepPolicy{fixed, start}, 50us, 40us);
    EXPECT_NEAR(base::to_seconds(awake), 0.8, 0.005);
}

TEST(SleepPolicy, WatchesWithoutLimitWhereThatIsAskedFor)
{
    const SleepPolicy policy{fixed, start, SleepPolicy::Watching::without_limit};
    EXPECT_GE(awake_in_a_second(policy, 60us, 10us), 990ms);
}

TEST(SleepPolicy, LearnsNothingFromASleepThatADatagramEnded)
{
    SleepPolicy policy{learning, start};
    const auto before = policy.margin();
    const auto plan = policy.plan(start + 1ms, start);
    policy.on_wake_up(plan, {start, start + 2ms, true});
    policy.on_wake_up(plan, {start, start + 10us, false}); // a signal
    policy.on_wake_up(SleepPolicy::Sleep{}, {start, start + 2ms, false});
    policy.on_wake_up(SleepPolicy::Yield{start}, {start, start + 2ms, false});
    EXPECT_EQ(policy.margin(), before);
}

} // namespace
} // namespace hapnet::emulator::sleep_policy_test
