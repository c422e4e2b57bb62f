// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The levels at which a search plays all seeds, for laws whose limit is known; and the comparison
// with the paper's numbers.
#include "lab/experiment/search.hpp"
#include "lab/results/paper.hpp"

#include <gtest/gtest.h>

namespace hapnet::lab::experiment {

namespace {

/// A range in whole units.
SearchRange range(std::int64_t from, std::int64_t to, std::int64_t step, std::int64_t resolution)
{
    return {Impairment::delay, {1000 * from}, {1000 * to}, {1000 * step}, {1000 * resolution}};
}

/// Seed i of a search fails above `first + i * apart`, in whole units.
Failures from(std::int64_t first, std::int64_t apart)
{
    return [=](ImpairmentLevel level, std::uint32_t seeds) -> base::Result<std::uint32_t> {
        std::uint32_t failed = 0;
        for (std::uint32_t i = 0; i < seeds; ++i)
            failed += level.thousandths > 1000 * (first + apart * std::int64_t{i}) ? 1U : 0U;
        return failed;
    };
}

std::vector<std::int64_t> whole(const std::vector<ImpairmentLevel>& levels)
{
    std::vector<std::int64_t> units;
    for (const ImpairmentLevel level : levels) units.push_back(level.thousandths / 1000);
    return units;
}

} // namespace

TEST(Search, CountsEightLevelsAcrossTheOnsetWhereverItIs)
{
    for (std::int64_t first = 10; first < 300; first += 7) {
        const auto levels = levels_to_count(range(0, 320, 40, 5), 40, from(first, 0));
        ASSERT_TRUE(levels);
        EXPECT_GE(levels->size(), counted_levels) << first;
        EXPECT_LE(levels->front().thousandths, 1000 * first) << first;
        EXPECT_GT(levels->back().thousandths, 1000 * first) << first;
        for (std::size_t i = 1; i < levels->size(); ++i) {
            const auto gap = (*levels)[i].thousandths - (*levels)[i - 1].thousandths;
            EXPECT_TRUE(gap > 0 && gap % 5000 == 0) << first;
        }
    }
}

TEST(Search, GoesOnUntilATenthAndAHalfOfAllSeedsLieWithin)
{
    // The four seeds of the scan fail above 100 to 103, the others up to 139.
    const auto failures = from(100, 1);
    const auto levels = levels_to_count(range(0, 320, 40, 1), 40, failures);
    ASSERT_TRUE(levels);
    EXPECT_LE(*failures(levels->front(), 40), 4U);
    EXPECT_GE(*failures(levels->back(), 40), 20U);
}

TEST(Search, LeavesItAtTheTopWhenNothingFails)
{
    const auto none = levels_to_count(range(0, 99, 10, 1), 40, from(99, 0));
    ASSERT_TRUE(none);
    EXPECT_EQ(whole(*none), std::vector<std::int64_t>{99});
    // One of the other seeds fails at the top.
    const Failures rare = [](ImpairmentLevel level, std::uint32_t seeds) {
        const bool is_top = level.thousandths >= 99'000;
        return base::Result<std::uint32_t>{seeds > scan_seeds && is_top ? 1U : 0U};
    };
    const auto top = levels_to_count(range(0, 99, 10, 1), 40, rare);
    ASSERT_TRUE(top);
    EXPECT_GE(top->size(), counted_levels);
    EXPECT_EQ(whole(*top).back(), 99);
}

TEST(Search, LooksBelowTheRangeWhenItsFirstLevelFails)
{
    const auto levels = levels_to_count(range(50, 99, 10, 1), 40, from(20, 0));
    ASSERT_TRUE(levels);
    EXPECT_LE(whole(*levels).front(), 20);
    EXPECT_GT(whole(*levels).back(), 20);
    const auto never = levels_to_count(range(50, 99, 10, 1), 40, from(-1, 0));
    ASSERT_TRUE(never);
    EXPECT_EQ(whole(*never).front(), 0);
}

TEST(Search, IsNotMisledByASingleLevelThatFails)
{
    // One of four seeds fails at 40 alone, as if one delay excited a resonance. All fail above 160.
    const Failures failures = [](ImpairmentLevel level, std::uint32_t seeds) {
        const bool is_high = level.thousandths > 160'000;
        const std::uint32_t few = level.thousandths == 40'000 ? seeds / 4 : 0;
        return base::Result<std::uint32_t>{is_high ? seeds : few};
    };
    const auto levels = levels_to_count(range(0, 320, 40, 5), 40, failures);
    ASSERT_TRUE(levels);
    EXPECT_LT(whole(*levels).front(), 160);
    EXPECT_GT(whole(*levels).back(), 160);
}

TEST(Search, PassesAnErrorOn)
{
    const Failures failures = [](ImpairmentLevel level,
                                 std::uint32_t) -> base::Result<std::uint32_t> {
        if (level.thousandths > 40'000) return base::fail("no more");
        return 0;
    };
    const auto levels = levels_to_count(range(0, 100, 10, 5), 40, failures);
    ASSERT_FALSE(levels);
    EXPECT_EQ(levels.error().message, "no more");
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

TEST(Levels, OfTheIntervalThinTheMessagesAndLeaveThePath)
{
    emulator::Path ground;
    ground.up.loss.push_back(emulator::RandomLoss{});
    EXPECT_EQ(impaired(ground, Impairment::interval, {20'000}), ground);
    const peer::SendPolicy deadband{.deadband = base::Probability::from_fraction(0.08).value()};
    peer::SendPolicy twentieth;
    twentieth.every = 20;
    EXPECT_EQ(thinned(deadband, Impairment::interval, {20'000}), twentieth);
    EXPECT_EQ(thinned(deadband, Impairment::interval, {}), deadband) << "at rest";
    EXPECT_EQ(thinned(deadband, Impairment::delay, {20'000}), deadband);
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

namespace {

/// A limit with this interval, whose replicates are all in its middle.
metrics::Threshold around(double p50, double half_width = 0.5)
{
    metrics::Threshold threshold{
        .p50 = p50, .low = p50 - half_width, .high = p50 + half_width, .seeds = 40};
    threshold.replicates.assign(metrics::bootstrap_replicates, p50);
    return threshold;
}

metrics::Threshold never_reached(double top)
{
    metrics::Threshold threshold{.p50 = top, .is_open = true, .low = top, .seeds = 40};
    threshold.replicates.assign(metrics::bootstrap_replicates, metrics::beyond);
    return threshold;
}

} // namespace

TEST(Paper, ALimitIsMetMissedOrUndecidedByItsInterval)
{
    using enum Impairment;
    using results::LimitStatus;
    const auto base = around(160.0);
    EXPECT_EQ(results::limit_status("base", delay, base, &base), LimitStatus::calibrated);
    EXPECT_EQ(results::limit_status("base", delay, around(140.0), nullptr),
              LimitStatus::calibrated_missed);
    EXPECT_EQ(results::limit_status("base", delay, around(152.0), nullptr), LimitStatus::undecided);
    EXPECT_EQ(results::limit_status("base", delay, never_reached(320.0), nullptr),
              LimitStatus::calibrated_missed);
    EXPECT_EQ(results::limit_status("base", burst_loss, around(44.0), nullptr),
              LimitStatus::selected_met);
    EXPECT_EQ(results::limit_status("sep", delay, around(167.0), &base),
              LimitStatus::predicted_met);
    EXPECT_EQ(results::limit_status("sep", delay, around(180.0), &base),
              LimitStatus::predicted_missed);
    EXPECT_EQ(results::limit_status("sep", burst_loss, base, &base),
              LimitStatus::by_construction_met);
    EXPECT_EQ(results::limit_status("dead-reckoning", delay, around(140.0), &base),
              LimitStatus::predicted_met);
    EXPECT_EQ(results::limit_status("dead-reckoning", delay, around(129.8), &base),
              LimitStatus::undecided);
    const auto early = around(135.0);
    EXPECT_EQ(results::limit_status("dead-reckoning", delay, around(140.0), &early),
              LimitStatus::predicted_missed)
        << "more than base's";
    EXPECT_EQ(results::limit_status("dead-reckoning", jitter, around(4.0), nullptr),
              LimitStatus::selected_met);
    const auto burst = around(44.0);
    EXPECT_EQ(results::limit_status("dead-reckoning", burst_loss, around(73.0), &burst),
              LimitStatus::predicted_missed)
        << "73 is not the paper's 50";
}

TEST(Paper, StatesNoLimitOfJitterButDeadReckoningsAndNoneWithoutBase)
{
    using enum Impairment;
    EXPECT_EQ(results::paper_limit("base", jitter), std::nullopt);
    EXPECT_EQ(results::paper_limit("sep", jitter), std::nullopt);
    EXPECT_EQ(results::paper_limit("dead-reckoning", jitter), 5.0);
    EXPECT_EQ(results::limit_status("base", jitter, never_reached(20.0), nullptr),
              results::LimitStatus::none);
    EXPECT_EQ(results::limit_status("dead-reckoning", delay, around(140.0), nullptr),
              results::LimitStatus::none);
    const auto base = around(160.0);
    EXPECT_EQ(results::limit_status("mine", delay, base, &base), results::LimitStatus::none);
}

TEST(Paper, EveryLimitHasAClass)
{
    using enum Impairment;
    using results::Provenance;
    EXPECT_EQ(results::limit_provenance("base", delay, "worst"), Provenance::calibrated);
    EXPECT_EQ(results::limit_provenance("base", delay, "T3"), Provenance::predicted);
    EXPECT_EQ(results::limit_provenance("base", burst_loss, "worst"), Provenance::selected);
    EXPECT_EQ(results::limit_provenance("sep", random_loss, "worst"), Provenance::by_construction);
    EXPECT_EQ(results::limit_provenance("sep", delay, "worst"), Provenance::predicted);
    EXPECT_EQ(results::limit_provenance("dead-reckoning", jitter, "worst"), Provenance::selected);
    EXPECT_EQ(results::limit_provenance("dead-reckoning", burst_loss, "worst"),
              Provenance::predicted);
    EXPECT_EQ(results::limit_provenance("mine", delay, "worst"), Provenance::none);
}

} // namespace hapnet::lab::experiment
