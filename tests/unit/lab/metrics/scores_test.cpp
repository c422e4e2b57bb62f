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
    EXPECT_DOUBLE_EQ(*scores.stiffness_error, 0.8);
    EXPECT_FALSE(scores.slow_stiffness_error);
    impaired.stiffness_n_per_m[judged_press][1].reset(); // it ended before R's turn
    EXPECT_EQ(*scores_of(impaired, perfect).stiffness_ratio[judged_press], 10.0 / 120.0);
    EXPECT_DOUBLE_EQ(*scores.contact_lost, 0.04);
    EXPECT_DOUBLE_EQ(*scores.response_added_s, 0.16);
    EXPECT_FALSE(scores.drag_n);
}

TEST(Scores, CallStiffnessWrongThatComesLateOrIsTooMuch)
{
    Metrics due{.task = Task::t2, .scored_s = 27.0};
    for (std::size_t press = 0; press < press_hertz.size(); ++press) {
        due.stiffness_n_per_m[press] = {200.0, 200.0};
        due.loss_stiffness_n_per_m[press] = {0.0, 0.0};
    }
    Metrics felt = due;
    EXPECT_EQ(*scores_of(felt, due).stiffness_error, 0.0);
    felt.stiffness_n_per_m[2] = {0.0, 0.0}; // of the right size, a quarter period late
    felt.loss_stiffness_n_per_m[2] = {-200.0, -200.0};
    const Scores late = scores_of(felt, due);
    EXPECT_DOUBLE_EQ(*late.stiffness_ratio[2], 1.0);
    EXPECT_DOUBLE_EQ(*late.stiffness_error, std::sqrt(2.0));
    EXPECT_EQ(*late.slow_stiffness_error, 0.0);
    felt.stiffness_n_per_m[0] = {1160.0, 1160.0}; // 5.8 times the right value
    const Scores hard = scores_of(felt, due);
    EXPECT_DOUBLE_EQ(*hard.stiffness_error, 4.8);
    EXPECT_DOUBLE_EQ(*hard.slow_stiffness_error, 4.8);
}

TEST(Scores, HoldStiffnessAgainstOneSharedWorldAndNotAgainstASoftAlgorithmsOwn)
{
    Metrics own{.task = Task::t2, .scored_s = 27.0};
    own.stiffness_n_per_m[judged_press] = {27.0, 27.0};
    own.drag_n = {0.1, 0.2};
    Metrics one_world{.task = Task::t2, .scored_s = 27.0};
    one_world.stiffness_n_per_m[judged_press] = {200.0, 200.0};
    Metrics felt = own;
    felt.stiffness_n_per_m[judged_press] = {66.0, 66.0};
    const Metrics reference = make_reference(own, one_world);
    EXPECT_EQ(reference.drag_n, own.drag_n);
    EXPECT_DOUBLE_EQ(*scores_of(felt, reference).stiffness_ratio[judged_press], 0.33);
    EXPECT_DOUBLE_EQ(*scores_of(felt, reference).stiffness_error, 0.67);
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
