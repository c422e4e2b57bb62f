// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/calibration.hpp"
#include "lab/metrics/verdict.hpp"
#include "tests/unit/lab/metrics/made_scores.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace hapnet::lab::metrics {
namespace {

TEST(Calibration, LetsTheWorstSessionJustPass)
{
    std::vector<Scores> delayed{perfect(), perfect(), perfect()};
    delayed[0].stiffness_ratio[judged_press] = 0.0611;
    delayed[1].stiffness_ratio[judged_press] = 0.0524;
    delayed[2].stiffness_ratio[judged_press].reset(); // another task
    std::vector<Scores> lossy{perfect(), perfect()};
    lossy[0].vibration_m = ByOrder{.first = 1.034e-3, .second = 0.9e-3, .fourth = 0.5e-3};
    lossy[1].vibration_m = ByOrder{.first = 0.9e-3, .second = 1.001e-3, .fourth = 0.8e-3};
    const auto found = calibrated({.at_delay = delayed, .at_random_loss = lossy}, {});
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_DOUBLE_EQ(found->usable.vibration_max_m.first, 1.04e-3);
    EXPECT_DOUBLE_EQ(found->usable.vibration_max_m.second, 1.01e-3);
    EXPECT_DOUBLE_EQ(found->usable.vibration_max_m.fourth, 0.8e-3);
    EXPECT_DOUBLE_EQ(found->usable.stiffness_ratio_min, 0.052);
    EXPECT_EQ(found->usable.force_vibration_max_n, Criteria{}.usable.force_vibration_max_n);
    for (const Scores& scores : lossy) EXPECT_TRUE(judge(scores, *found).failures.empty());
    for (const Scores& scores : delayed) EXPECT_TRUE(judge(scores, *found).failures.empty());
}

TEST(Calibration, DoesNotHideThatSomethingElseFailsFirst)
{
    std::vector<Scores> lossy{perfect()};
    lossy[0].force_vibration_added_n->first = 0.2;
    const std::vector<Scores> delayed{perfect()};
    const auto found = calibrated({.at_delay = delayed, .at_random_loss = lossy}, {});
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().message, "a session to calibrate on is not usable in any case: T2: "
                                     "force vibration added 0.2 N > 0.1 N");
}

TEST(Calibration, NeedsSessionsThatTellTheNumbers)
{
    const std::vector<Scores> told{perfect()};
    const std::vector<Scores> silent{Scores{.scored_share = 1.0}};
    EXPECT_FALSE(calibrated({.at_delay = told, .at_random_loss = silent}, {}));
    EXPECT_FALSE(calibrated({.at_delay = silent, .at_random_loss = told}, {}));
    EXPECT_FALSE(calibrated({}, {}));
    std::vector<Scores> limp{perfect()};
    limp[0].stiffness_ratio[judged_press] = -0.02;
    EXPECT_FALSE(calibrated({.at_delay = limp, .at_random_loss = told}, {}));
}

} // namespace
} // namespace hapnet::lab::metrics
