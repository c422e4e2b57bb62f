// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/psychometric.hpp"

#include "proto/base/math.hpp"
#include "proto/base/random.hpp"

#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <sstream>
#include <string>

namespace hapnet::lab::metrics {
namespace {

/// Seed i fails from its own level on, drawn from the core's distribution. `early` seeds fail
/// everywhere.
std::vector<LevelOutcome> drawn(const Psychometric& truth, const std::vector<double>& levels,
                                std::uint32_t seeds, std::uint64_t run)
{
    const auto stream = base::Seed{run}.stream("own level");
    std::vector<LevelOutcome> outcomes;
    for (const double level : levels) {
        LevelOutcome outcome{level, {}};
        for (std::uint32_t i = 0; i < seeds; ++i) {
            const double u = std::clamp(stream.uniform(i), 1e-6, 1.0 - 1e-6);
            const double z = truth.core == Core::gumbel ? base::log(-base::log(1.0 - u))
                                                        : base::log(u / (1.0 - u));
            const double own = truth.location + truth.scale * z;
            outcome.failed.push_back(stream.uniform(i, 1) < truth.early || level > own);
        }
        outcomes.push_back(std::move(outcome));
    }
    return outcomes;
}

const std::vector<double> eight{100.0, 110.0, 120.0, 130.0, 140.0, 150.0, 160.0, 170.0};

TEST(Psychometric, FindsTheCurveThatTheCountsAreOf)
{
    const Psychometric truth{.location = 134.0, .scale = 6.0, .early = 0.05, .late = 0.0};
    std::vector<FailCount> counts;
    for (const double level : eight)
        counts.push_back({level, 1000.0 * truth.share_at(level), 1000.0});
    const auto found = fitted(counts);
    EXPECT_NEAR(found.location, truth.location, 0.05);
    EXPECT_NEAR(found.scale, truth.scale, 0.1);
    EXPECT_EQ(found.early, 0.05);
    EXPECT_EQ(found.late, 0.0);
    EXPECT_NEAR(found.level_of(0.5), truth.level_of(0.5), 0.05);
    EXPECT_NEAR(found.share_at(found.level_of(0.1)), 0.1, 1e-12);
}

TEST(Psychometric, LiesHalfWayWhereAllSeedsChangeBetweenTwoLevels)
{
    std::vector<FailCount> counts;
    for (const double level : eight) counts.push_back({level, level > 135.0 ? 40.0 : 0.0, 40.0});
    EXPECT_NEAR(fitted(counts).level_of(0.5), 135.0, 0.01);
    std::vector<LevelOutcome> outcomes;
    for (const double level : eight)
        outcomes.push_back({level, std::vector<bool>(40, level > 135.0)});
    const auto threshold = threshold_of(outcomes, 320.0);
    EXPECT_NEAR(threshold.p50, 135.0, 0.01);
    EXPECT_LE(threshold.low, 130.0) << "no more is known than the two levels";
    EXPECT_GE(threshold.high.value_or(0.0), 140.0);
}

std::vector<std::string> cells_of(const std::string& line)
{
    std::vector<std::string> cells;
    std::istringstream stream{line};
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    return cells;
}

std::vector<double> numbers_in(const std::string& cell)
{
    std::istringstream stream{cell};
    return {std::istream_iterator<double>{stream}, {}};
}

TEST(Psychometric, FitsTheTableThatPythonFitsToo)
{
    // python/hapnet/study fits people's answers in the same way, and is compared with the same
    // table: tests/e2e/study/fit_test.py.
    std::ifstream table{HAPNET_REFERENCE "/psychometric.csv"};
    std::string line;
    int cases = 0;
    std::getline(table, line);
    EXPECT_EQ(line, "case,levels,failed,of,location,scale,early,late,core,p50");
    for (; std::getline(table, line); ++cases) {
        const auto cells = cells_of(line);
        ASSERT_EQ(cells.size(), 10U) << line;
        const auto levels = numbers_in(cells[1]), failed = numbers_in(cells[2]);
        const auto of = numbers_in(cells[3]);
        ASSERT_TRUE(levels.size() == failed.size() && levels.size() == of.size()) << line;
        std::vector<FailCount> counts;
        for (std::size_t i = 0; i < levels.size(); ++i)
            counts.push_back({levels[i], failed[i], of[i]});
        const auto found = fitted(counts);
        EXPECT_NEAR(found.location, std::stod(cells[4]), 1e-5) << line;
        EXPECT_NEAR(found.scale, std::stod(cells[5]), 1e-5) << line;
        EXPECT_EQ(found.early, std::stod(cells[6])) << line;
        EXPECT_EQ(found.late, std::stod(cells[7])) << line;
        EXPECT_EQ(found.core == Core::gumbel ? "gumbel" : "logistic", cells[8]) << line;
        EXPECT_NEAR(found.level_of(0.5), std::stod(cells[9]), 1e-5) << line;
    }
    EXPECT_EQ(cases, 37);
}

/// Tests over a number of runs.
class ThresholdInterval : public testing::TestWithParam<std::uint64_t> {
protected:
    static void expect_to_hold(const Psychometric& truth, const std::vector<double>& levels)
    {
        constexpr std::uint32_t seeds = 40;
        const double p50 = truth.level_of(0.5);
        int held = 0;
        for (std::uint64_t run = 0; run < GetParam(); ++run) {
            const auto threshold = threshold_of(drawn(truth, levels, seeds, 100 + run), 320.0);
            held += threshold.low <= p50 && threshold.high.value_or(beyond) >= p50 ? 1 : 0;
        }
        // With 95 % coverage, fewer occur in one of 300 cases.
        EXPECT_GE(held, GetParam() == 40 ? 34 : 16);
    }
};

TEST_P(ThresholdInterval, HoldsTheTruthInAboutNineteenOfTwentyRuns)
{
    expect_to_hold({.location = 134.0, .scale = 6.0}, eight);
}

TEST_P(ThresholdInterval, HoldsTheTruthOfASkewedCurve)
{
    // Like the delay limit of dead reckoning: a slow rise, then a steep end. The fit of a logistic
    // alone is too low here.
    expect_to_hold({.location = 129.0, .scale = 7.0, .core = Core::gumbel}, eight);
}

TEST_P(ThresholdInterval, HoldsTheTruthWhereLevelsAreTooFarApartToShowTheCurve)
{
    // Nearly all seeds change between two levels, like those of dead reckoning with jitter at
    // levels 0.25 ms apart. The replicates of the fit alone contain the truth in 20 of 40 runs.
    expect_to_hold({.location = 4.05, .scale = 0.0125},
                   {3.25, 3.5, 3.75, 4.0, 4.25, 4.5, 4.75, 5.0});
}

INSTANTIATE_TEST_SUITE_P(Runs, ThresholdInterval, testing::Values(20U));
INSTANTIATE_TEST_SUITE_P(All, ThresholdInterval, testing::Values(40U));

TEST(Interval, OfFewSeedsIsWiderThanThePercentilesOfTheReplicates)
{
    std::vector<double> values;
    for (int i = 1; i <= 1000; ++i) values.push_back(i / 1000.0);
    // Student's t with 39, 9 and 3 degrees of freedom, times sqrt(n / (n - 1)), as shares of a
    // normal distribution: 0.0203, 0.0086, 0.0001.
    EXPECT_EQ(interval_of(values, 40).low, 0.021);
    EXPECT_EQ(interval_of(values, 40).high, 0.98);
    EXPECT_EQ(interval_of(values, 10).low, 0.009);
    EXPECT_EQ(interval_of(values, 4).low, 0.001);
    EXPECT_EQ(interval_of(values, interval_seeds_min - 1).low, values.front()) << "not 95 %";
    EXPECT_GT(interval_of(values, interval_seeds_min).low, values.front());
}

TEST(Threshold, NeverReachedIsOpenAndHasNoUpperEnd)
{
    const std::vector<LevelOutcome> outcomes{{320.0, std::vector<bool>(40, false)}};
    const auto threshold = threshold_of(outcomes, 320.0);
    EXPECT_TRUE(threshold.is_open);
    EXPECT_EQ(threshold.p50, 320.0);
    EXPECT_EQ(threshold.low, 320.0);
    EXPECT_EQ(threshold.high, std::nullopt);
    EXPECT_EQ(threshold.p10, std::nullopt);
}

TEST(Threshold, HasTheSameBitsAgain)
{
    const auto outcomes = drawn({.location = 134.0, .scale = 6.0}, eight, 40, 1);
    const auto a = threshold_of(outcomes, 320.0), b = threshold_of(outcomes, 320.0);
    EXPECT_EQ(a.p50, b.p50);
    EXPECT_EQ(a.replicates, b.replicates);
}

TEST(Threshold, DifferencesArePaired)
{
    const auto outcomes = drawn({.location = 134.0, .scale = 6.0}, eight, 40, 1);
    std::vector<LevelOutcome> later = outcomes; // the same seeds, 10 higher
    for (LevelOutcome& outcome : later) outcome.level += 10.0;
    const auto a = threshold_of(later, 320.0), b = threshold_of(outcomes, 320.0);
    const auto difference = difference_of(a, b);
    EXPECT_NEAR(difference.value, 10.0, 1e-6);
    EXPECT_NEAR(difference.interval.low, 10.0, 1e-6) << "far narrower than either interval";
    EXPECT_NEAR(difference.interval.high, 10.0, 1e-6);
    EXPECT_GT(*b.high - b.low, 2.0);
    const std::vector<LevelOutcome> never{{320.0, std::vector<bool>(40, false)}};
    const auto open = threshold_of(never, 320.0);
    EXPECT_EQ(difference_of(open, open).value, 0.0);
    EXPECT_EQ(difference_of(open, b).interval.low, beyond);
}

} // namespace
} // namespace hapnet::lab::metrics
