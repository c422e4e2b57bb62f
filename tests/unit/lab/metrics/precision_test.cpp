// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/precision.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace hapnet::lab::metrics {
namespace {

TEST(Precision, FindsTheOrderWithWhichErrorsFall)
{
    for (const double order : {0.5, 1.0, 2.0, 4.0}) {
        std::vector<StepError> errors, against_finer;
        for (const double step : {4.0, 2.0, 1.0, 0.5}) {
            errors.push_back({step, 0.03 * std::pow(step, order)});
            against_finer.push_back({step, 0.03 * (std::pow(step, order) - std::pow(0.2, order))});
        }
        EXPECT_NEAR(*order_of(errors), order, 1e-3);
        EXPECT_NEAR(*order_of(against_finer, 0.2), order, 1e-3);
        // With the reference taken as the truth, errors seem to fall faster.
        EXPECT_GT(*order_of(against_finer), order + 1e-3);
    }
}

TEST(Precision, FindsNoOrderInFewerThanTwoSteps)
{
    EXPECT_FALSE(order_of({}));
    EXPECT_FALSE(order_of(std::array{StepError{1.0, 0.1}}));
    EXPECT_FALSE(order_of(std::array{StepError{1.0, 0.1}, StepError{1.0, 0.2}}));
    EXPECT_FALSE(order_of(std::array{StepError{1.0, 0.2}, StepError{2.0, 0.1}})) << "they grow";
}

TEST(Precision, OfAMeanFallsWithTheRootOfTheNumberOfSeeds)
{
    // Half of the seeds have 4, half have 6: a deviation of 1 about 5.
    std::vector<double> by_seed;
    for (int seed = 0; seed < 40; ++seed) by_seed.push_back(seed % 2 == 0 ? 4.0 : 6.0);
    std::vector<StepError> errors;
    for (const std::size_t seeds : {1U, 2U, 5U, 10U, 20U, 40U}) {
        const double error = root_mean_square_error(mean_replicates(by_seed, seeds), 5.0);
        // A root mean square over 1000 draws has a standard error of 2.2 %.
        EXPECT_NEAR(error * std::sqrt(static_cast<double>(seeds)), 1.0, 0.07) << seeds;
        errors.push_back({1.0 / static_cast<double>(seeds), error});
    }
    EXPECT_NEAR(*order_of(errors), 0.5, 0.02);
}

TEST(Precision, ReachesTheErrorOfTheStepHoweverManySeedsThereAre)
{
    const std::vector<double> by_seed{4.0, 6.0};
    const double truth = 5.3;
    EXPECT_NEAR(root_mean_square_error(mean_replicates(by_seed, 1000), truth), 0.3, 0.01);
    EXPECT_NEAR(root_mean_square_error(mean_replicates(by_seed, 1), truth), std::hypot(1.0, 0.3),
                0.05);
}

TEST(Precision, IsPairedByTheSeedsThatAreDrawn)
{
    std::vector<double> here, there;
    for (int seed = 0; seed < 40; ++seed) {
        here.push_back(seed * seed);
        there.push_back(seed * seed - 0.25);
    }
    const auto interval =
        paired_interval(mean_replicates(here, 40), mean_replicates(there, 40), 40);
    EXPECT_NEAR(interval.low, 0.25, 1e-9) << "what the seeds have in common does not widen it";
    EXPECT_NEAR(interval.high, 0.25, 1e-9);
}

TEST(Precision, OfALimitByAllSeedsIsItsReplicatesAndByFewerSpreadsWider)
{
    std::vector<LevelOutcome> outcomes;
    for (const int level : {10, 20, 30, 40, 50, 60}) {
        LevelOutcome& outcome = outcomes.emplace_back(LevelOutcome{static_cast<double>(level), {}});
        for (int seed = 0; seed < 40; ++seed) outcome.failed.push_back(15 + seed < level);
    }
    const auto threshold = threshold_of(outcomes, 100.0);
    EXPECT_EQ(p50_replicates(outcomes, 40), threshold.replicates);
    const double by_40 = root_mean_square_error(p50_replicates(outcomes, 40), threshold.p50);
    const double by_10 = root_mean_square_error(p50_replicates(outcomes, 10), threshold.p50);
    EXPECT_NEAR(by_10 / by_40, 2.0, 0.5) << "four times fewer seeds";
}

} // namespace
} // namespace hapnet::lab::metrics
