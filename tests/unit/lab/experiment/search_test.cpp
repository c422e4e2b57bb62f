// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Where a search says that the limit is, for laws whose limit is known; and what the paper's
// numbers are compared by.
#include "lab/experiment/search.hpp"
#include "lab/results/paper.hpp"

#include <gtest/gtest.h>

namespace hapnet::lab::experiment {

namespace {

/// In whole units.
SearchRange range(std::int64_t from, std::int64_t to, std::int64_t step, std::int64_t resolution)
{
    return {Impairment::delay, {1000 * from}, {1000 * to}, {1000 * step}, {1000 * resolution}};
}

Limit found(std::int64_t level) { return {{1000 * level}, true}; }

/// Passes up to `last`, in whole units.
Passes up_to(std::int64_t last)
{
    return [last](ImpairmentLevel level) -> base::Result<bool> {
        return level.thousandths <= 1000 * last;
    };
}

} // namespace

TEST(Search, FindsEveryLimitOfItsGridExactly)
{
    for (std::int64_t last = 0; last < 320; ++last) {
        EXPECT_EQ(*find_limit(range(0, 320, 40, 5), up_to(last)), found(last / 5 * 5)) << last;
    }
    for (std::int64_t last = 50; last < 99; ++last) {
        EXPECT_EQ(*find_limit(range(50, 99, 10, 1), up_to(last)), found(last)) << last;
    }
}

TEST(Search, SaysWhenNothingFailedWithinTheRange)
{
    EXPECT_EQ(*find_limit(range(0, 99, 10, 1), up_to(99)), (Limit{{99'000}, false}));
}

TEST(Search, LooksBelowTheRangeWhenItsFirstLevelFails)
{
    for (std::int64_t last = 0; last < 50; ++last) {
        EXPECT_EQ(*find_limit(range(50, 99, 10, 1), up_to(last)), found(last)) << last;
    }
    const Passes never = [](ImpairmentLevel) -> base::Result<bool> { return false; };
    EXPECT_EQ(*find_limit(range(50, 99, 10, 1), never), found(0));
    EXPECT_EQ(*find_limit(range(0, 99, 10, 1), never), found(0));
}

TEST(Search, StopsAtTheFirstFailureWhateverPassesBeyond)
{
    std::vector<std::int64_t> visited;
    const auto limit =
        find_limit(range(0, 100, 10, 5), [&](ImpairmentLevel level) -> base::Result<bool> {
            visited.push_back(level.thousandths / 1000);
            return level.thousandths != 30'000; // one bad level, as a buzz at one delay would be
        });
    EXPECT_EQ(*limit, found(25));
    EXPECT_EQ(visited, (std::vector<std::int64_t>{0, 10, 20, 30, 25}));
}

TEST(Search, PassesAnErrorOn)
{
    const auto limit =
        find_limit(range(0, 100, 10, 5), [](ImpairmentLevel level) -> base::Result<bool> {
            if (level.thousandths > 40'000) return base::fail("no more");
            return true;
        });
    ASSERT_FALSE(limit);
    EXPECT_EQ(limit.error().message, "no more");
}

TEST(Levels, ArePutAsPeopleReadThem)
{
    EXPECT_EQ(to_text(ImpairmentLevel{160'000}), "160");
    EXPECT_EQ(to_text(ImpairmentLevel{4'500}), "4.5");
    EXPECT_EQ(to_text(ImpairmentLevel{92'125}), "92.125");
    EXPECT_EQ(to_text(ImpairmentLevel{0}), "0");
}

TEST(Levels, ImpairBothWaysOnTopOfWhatIsThere)
{
    emulator::Path ground;
    ground.up.loss.push_back(emulator::RandomLoss{});
    const auto burst = impaired(ground, Impairment::burst_loss, {40'000});
    EXPECT_EQ(burst.up.loss.size(), 2U);
    EXPECT_EQ(burst.down.loss, (std::vector<emulator::LossLaw>{emulator::Burst{40, 100, {}}}));
    const auto jitter = impaired(ground, Impairment::jitter, {5'000});
    EXPECT_EQ(jitter.down.delay, emulator::constant(std::chrono::milliseconds{5}));
    EXPECT_EQ(jitter.down.jitter, emulator::uniform(std::chrono::milliseconds{5}));
    EXPECT_EQ(jitter.down.order, emulator::Order::free);
    EXPECT_EQ(impaired(ground, Impairment::jitter, {}), ground);
}

TEST(Paper, Table1IsMetWithinItsBandsAndNotBeyond)
{
    const metrics::Spread base{13.25, 0.0, 44.5, 10.57};
    EXPECT_EQ(results::table1_verdict("base", base, base), results::Claim::calibrated);
    EXPECT_EQ(results::table1_verdict("base", {15.2, 0.0, 46.0, 10.99}, {}),
              results::Claim::missed); // 10 %: 15.168
    EXPECT_EQ(results::table1_verdict("sep", {13.6, 0.0, 45.0, 10.6}, base), results::Claim::met);
    EXPECT_EQ(results::table1_verdict("sep", {13.7, 0.0, 45.0, 10.6}, base),
              results::Claim::missed); // 3 %: 13.65
    EXPECT_EQ(results::table1_verdict("sep", base, {}), results::Claim::missed);
    EXPECT_EQ(results::table1_verdict("dead-reckoning", {3.8, 0.0, 41.0, 4.4}, base),
              results::Claim::met);
    EXPECT_EQ(results::table1_verdict("dead-reckoning", {3.3, 0.0, 66.0, 3.8}, base),
              results::Claim::missed);
    EXPECT_EQ(results::table1_verdict("mine", base, base), results::Claim::none);
}

TEST(Paper, LimitsAreCalibratedMetOrMissed)
{
    using enum Impairment;
    const results::FoundLimit base_delay{160.0, true};
    EXPECT_EQ(limit_status("base", delay, base_delay, {}), results::LimitStatus::calibrated);
    EXPECT_EQ(results::limit_status("base", delay, {150.0, true}, {}),
              results::LimitStatus::predicted_missed);
    EXPECT_EQ(results::limit_status("base", delay, {160.0, false}, {}),
              results::LimitStatus::predicted_missed);
    EXPECT_EQ(results::limit_status("base", random_loss, {92.0, true}, {}),
              results::LimitStatus::calibrated);
    EXPECT_EQ(results::limit_status("base", burst_loss, {45.0, true}, {}),
              results::LimitStatus::predicted_met);
    EXPECT_EQ(results::limit_status("base", jitter, {20.0, false}, {}),
              results::LimitStatus::predicted_met);
    EXPECT_EQ(results::limit_status("base", jitter, {14.5, true}, {}),
              results::LimitStatus::predicted_missed);
    EXPECT_EQ(limit_status("sep", delay, {165.0, true}, base_delay),
              results::LimitStatus::predicted_met);
    EXPECT_EQ(limit_status("sep", delay, {320.0, false}, base_delay),
              results::LimitStatus::predicted_missed);
    EXPECT_EQ(limit_status("sep", burst_loss, {40.0, true}, results::FoundLimit{40.0, true}),
              results::LimitStatus::predicted_met);
    EXPECT_EQ(limit_status("dead-reckoning", delay, {150.0, true}, base_delay),
              results::LimitStatus::predicted_met);
    EXPECT_EQ(
        limit_status("dead-reckoning", delay, {150.0, true}, results::FoundLimit{150.0, true}),
        results::LimitStatus::predicted_missed);
    EXPECT_EQ(results::limit_status("dead-reckoning", jitter, {6.0, true}, {}),
              results::LimitStatus::predicted_met);
    EXPECT_EQ(results::limit_status("dead-reckoning", jitter, {6.0, false}, {}),
              results::LimitStatus::predicted_missed);
    EXPECT_EQ(
        limit_status("dead-reckoning", random_loss, {80.0, true}, results::FoundLimit{93.0, true}),
        results::LimitStatus::predicted_met);
    EXPECT_EQ(
        limit_status("dead-reckoning", burst_loss, {95.0, false}, results::FoundLimit{40.0, true}),
        results::LimitStatus::predicted_met);
    EXPECT_EQ(limit_status("mine", delay, base_delay, base_delay), results::LimitStatus::none);
}

} // namespace hapnet::lab::experiment
