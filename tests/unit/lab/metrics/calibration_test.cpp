// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/calibration.hpp"
#include "lab/metrics/verdict.hpp"
#include "tests/unit/lab/metrics/made_scores.hpp"

#include <array>
#include <gtest/gtest.h>
#include <vector>

namespace hapnet::lab::metrics {
namespace {

TEST(Calibration, LetsHalfOfTheWorstTaskPass)
{
    std::vector<Scores> delayed(4, perfect());
    delayed[0].slow_stiffness_error = 0.8711;
    delayed[1].slow_stiffness_error = 0.8524;
    delayed[2].slow_stiffness_error = 0.8612;
    delayed[3].task = device::Task::t1;
    delayed[3].slow_stiffness_error.reset(); // another task
    std::vector<Scores> lossy(5, perfect());
    const std::array vibrations{1.01e-3, 1.034e-3, 0.9e-3};
    for (std::size_t i = 0; i < 3; ++i)
        lossy[i].vibration_m = ByOrder{.first = vibrations[i], .second = 0.9e-3, .fourth = 0.8e-3};
    for (std::size_t i = 3; i < 5; ++i) {
        lossy[i].task = device::Task::t3; // bears more
        lossy[i].vibration_m = ByOrder{.first = 0.4e-3, .second = 0.5e-3, .fourth = 0.6e-3};
    }
    const auto found = calibrated({.at_delay = delayed, .at_random_loss = lossy}, {});
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_DOUBLE_EQ(found->usable.vibration_max_m.first, 1.01e-3);
    EXPECT_DOUBLE_EQ(found->usable.vibration_max_m.second, 0.9e-3);
    EXPECT_DOUBLE_EQ(found->usable.vibration_max_m.fourth, 0.8e-3);
    EXPECT_DOUBLE_EQ(found->usable.slow_stiffness_error_max, 0.861);
    EXPECT_EQ(found->usable.force_vibration_max_n, Criteria{}.usable.force_vibration_max_n);
}

TEST(Calibration, DoesNotHideThatSomethingElseFailsFirst)
{
    std::vector<Scores> lossy{perfect(), perfect(), perfect()};
    const std::vector<Scores> delayed{perfect()};
    lossy[0].force_vibration_added_n->first = 0.2;
    EXPECT_TRUE(calibrated({.at_delay = delayed, .at_random_loss = lossy}, {}));
    lossy[1].force_vibration_added_n->first = 0.2;
    const auto found = calibrated({.at_delay = delayed, .at_random_loss = lossy}, {});
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().message,
              "more than half of the sessions to calibrate on are not usable in any case: T2: "
              "force vibration added 0.2 N > 0.1 N");
}

TEST(Calibration, NeedsSessionsThatTellTheNumbers)
{
    const std::vector<Scores> told{perfect()};
    const std::vector<Scores> silent{Scores{.scored_share = 1.0}};
    EXPECT_FALSE(calibrated({.at_delay = told, .at_random_loss = silent}, {}));
    EXPECT_FALSE(calibrated({.at_delay = silent, .at_random_loss = told}, {}));
    EXPECT_FALSE(calibrated({}, {}));
}

} // namespace
} // namespace hapnet::lab::metrics
