// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/scores.hpp"
#include "tests/unit/lab/metrics/made_traces.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace hapnet::lab::metrics {
namespace {

using device::Task;

TEST(Scores, TakeOffWhatThePerfectNetworkShows)
{
    Metrics perfect{.task = Task::t2, .scored_s = 27.0};
    perfect.body_vibration_m = {ByOrder{0.003, 0.003, 0.003}, ByOrder{0.0, 0.0, 0.001}};
    perfect.stiffness_n_per_m[judged_press] = {120.0, 80.0};
    perfect.contact_lost = {0.01, 0.02};
    perfect.response_s = 0.004;
    Metrics impaired{.task = Task::t2, .scored_s = 13.5};
    impaired.body_vibration_m = {ByOrder{0.005, 0.002, 0.003}, ByOrder{0.001, 0.0, 0.001}};
    impaired.stiffness_n_per_m[judged_press] = {10.0, 30.0};
    impaired.contact_lost = {0.05, 0.02};
    impaired.response_s = 0.164;
    const Scores scores = scores_of(impaired, perfect);
    EXPECT_EQ(scores.scored_share, 0.5);
    ASSERT_TRUE(scores.vibration_m);
    EXPECT_DOUBLE_EQ(scores.vibration_m->first, 0.004);
    EXPECT_EQ(scores.vibration_m->second, 0.0);
    EXPECT_EQ(scores.vibration_m->fourth, 0.0);
    EXPECT_EQ(scores.stiffness_ratio[judged_press], 0.2);
    EXPECT_FALSE(scores.stiffness_ratio[0]);
    impaired.stiffness_n_per_m[judged_press][1].reset(); // it ended before R's turn
    EXPECT_EQ(*scores_of(impaired, perfect).stiffness_ratio[judged_press], 10.0 / 120.0);
    EXPECT_DOUBLE_EQ(*scores.contact_lost, 0.04);
    EXPECT_DOUBLE_EQ(*scores.response_added_s, 0.16);
    EXPECT_FALSE(scores.drag_n);
}

TEST(Scores, KeepANumberThatIsNone)
{
    const double none = std::numeric_limits<double>::quiet_NaN();
    Metrics perfect{.scored_s = 27.0};
    perfect.body_vibration_m = {ByOrder{}, ByOrder{}};
    for (const std::size_t side : {0U, 1U}) {
        Metrics broken = perfect;
        broken.body_vibration_m[side]->first = none;
        EXPECT_TRUE(std::isnan(scores_of(broken, perfect).vibration_m->first));
    }
}

TEST(Scores, OfASessionThatNeverBeganHaveNoTimeTogether)
{
    const Metrics perfect = metrics_of(resting(Task::t1, 1000));
    EXPECT_EQ(scores_of(metrics_of(virtual_time::Trace{.task = Task::t1}), perfect).scored_share,
              0.0);
    EXPECT_EQ(scores_of(Metrics{}, Metrics{}).scored_share, 0.0);
}

} // namespace
} // namespace hapnet::lab::metrics
