// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/core/metrics/json.hpp"
#include "lab/core/metrics/metrics.hpp"
#include "lab/core/metrics/scores.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>

namespace hapnet::lab {
namespace {

using device::Task;

/// Both sides rest and touch nothing.
Trace resting(Task task, std::size_t ticks)
{
    Trace trace{.task = task};
    for (auto& side : trace.sides) side.resize(ticks);
    return trace;
}

/// T2 with hands that press on ideal springs, L's of 120 N/m and R's of 80, at the frequency of
/// each press; the resting hand feels the same force as the pressing one.
Trace pressing(double left_n_per_m, double right_n_per_m)
{
    Trace trace = resting(Task::t2, 27000);
    constexpr double pi = 3.14159265358979323846;
    struct Press {
        int begin_ms, end_ms;
        double hertz;
        std::size_t side;
    };
    for (const Press& press :
         {Press{1500, 7500, 0.5, 0}, Press{7500, 11500, 1.0, 0}, Press{11500, 13500, 2.0, 0},
          Press{14500, 20500, 0.5, 1}, Press{20500, 24500, 1.0, 1}, Press{24500, 26500, 2.0, 1}}) {
        const double stiffness = press.side == 0 ? left_n_per_m : right_n_per_m;
        for (int i = press.begin_ms; i < press.end_ms; ++i) {
            const double aim =
                0.0035 * std::sin(2.0 * pi * press.hertz * (i - press.begin_ms) * 0.001);
            const auto at = static_cast<std::size_t>(i);
            Sample& presser = trace.sides[press.side][at];
            Sample& holder = trace.sides[1 - press.side][at];
            presser.hip.value.x = aim;
            presser.on_hand.value.x = -0.57 - stiffness * aim;
            holder.on_hand.value.x = 0.57 + stiffness * aim;
            for (Sample* sample : {&presser, &holder}) {
                sample->on_body = sample->on_hand;
                sample->touching = true;
            }
        }
    }
    return trace;
}

TEST(Metrics, OfNothingAreNone)
{
    EXPECT_EQ(metrics_of(Trace{.task = Task::t3}), Metrics{.task = Task::t3});
}

TEST(Metrics, OfASingleTickDoNotFail)
{
    for (const Task task : device::all_tasks) {
        const Metrics metrics = metrics_of(resting(task, 1));
        EXPECT_EQ(metrics.scored_s, 0.001);
        EXPECT_EQ(metrics.discrepancy_m, Spread{});
        EXPECT_EQ(metrics.energy_taken_j, 0.0);
        EXPECT_FALSE(metrics.stiffness_n_per_m[judged_press][0]);
        EXPECT_FALSE(metrics.response_s);
        EXPECT_FALSE(metrics.similarity);
    }
}

TEST(Metrics, OfASessionAtRestAreZeroOrNone)
{
    const Metrics metrics = metrics_of(resting(Task::t2, 27000));
    EXPECT_EQ(metrics.scored_s, 27.0);
    EXPECT_EQ(metrics.discrepancy_m, Spread{});
    EXPECT_EQ(metrics.body_vibration_m[1], ByOrder{});
    EXPECT_EQ(metrics.force_vibration_n[0], ByOrder{});
    EXPECT_EQ(metrics.contact_lost[0], 1.0);
    EXPECT_FALSE(metrics.force_discrepancy);
    EXPECT_FALSE(metrics.stiffness_n_per_m[0][0]);
    EXPECT_FALSE(metrics.drops);
}

TEST(Metrics, FindTheSpringsThatArePressed)
{
    const Metrics metrics = metrics_of(pressing(120.0, 80.0));
    for (const auto& stiffness : metrics.stiffness_n_per_m) {
        ASSERT_TRUE(stiffness[0] && stiffness[1]);
        EXPECT_NEAR(*stiffness[0], 120.0, 1e-7);
        EXPECT_NEAR(*stiffness[1], 80.0, 1e-7);
    }
    EXPECT_EQ(metrics.force_discrepancy, 0.0);
    ASSERT_TRUE(metrics.similarity);
    EXPECT_NEAR(metrics.similarity->share, 1.0, 1e-9);
    EXPECT_EQ(metrics.similarity->lag_s, 0.0);
    // All but the second between the presses of either hand.
    EXPECT_NEAR(*metrics.contact_lost[0], 1.0 / 25.0, 1e-12);
}

TEST(Metrics, CountVibrationByTurnsOnlyWhereASideFollows)
{
    Trace trace = resting(Task::t1, 10000);
    for (std::size_t i = 0; i < 10000; ++i) {
        Sample& left = trace.sides[0][i];
        Sample& right = trace.sides[1][i];
        left.touching = true;
        right.remote_touching = true;
        left.body.value.x = i % 2 == 0 ? 0.001 : -0.001;
    }
    const Metrics metrics = metrics_of(trace);
    EXPECT_FALSE(metrics.body_vibration_m[0]); // it never follows
    EXPECT_EQ(metrics.body_vibration_m[1], ByOrder{});
    trace.task = Task::t3; // where both push
    EXPECT_NEAR(metrics_of(trace).body_vibration_m[0]->fourth, 0.001, 1e-4);
}

TEST(Metrics, TakeCatchingUpForDiscrepancyAlone)
{
    Trace trace = resting(Task::p1, 5000);
    trace.begin = base::Duration{1'082'000'000};
    for (Sample& sample : trace.sides[1]) sample.remote_touching = true;
    for (auto& side : trace.sides) {
        for (Sample& sample : side) sample.body.value.x = 0.07;
    }
    trace.sides[1][0].body.value.x = 0.0;
    const Metrics metrics = metrics_of(trace);
    EXPECT_EQ(metrics.discrepancy_m->max, 0.07);
    EXPECT_EQ(metrics.body_vibration_m[1], ByOrder{});
}

TEST(Metrics, KnowADroppedBodyFromOneThatIsHeld)
{
    Trace trace = resting(Task::t4, 27000);
    for (auto& side : trace.sides) {
        for (std::size_t i = 4000; i < 9500; ++i) side[i].body.value.y = 0.05;
        for (std::size_t i = 16500; i < 22000; ++i) side[i].body.value.y = 0.05;
    }
    EXPECT_EQ(metrics_of(trace).drops, 0.0);
    for (std::size_t i = 20000; i < 22000; ++i) trace.sides[1][i].body.value.y = 0.001;
    EXPECT_EQ(metrics_of(trace).drops, 1.0);
    EXPECT_EQ(metrics_of(resting(Task::t4, 27000)).drops, 2.0);
    EXPECT_FALSE(metrics_of(resting(Task::t4, 9000)).drops); // not played to the end
}

TEST(Metrics, SayHowFarABodyIsBeyondTheStaticCube)
{
    Trace trace = resting(Task::t5, 2000);
    trace.sides[1][1500].body.value.x = 0.0797;
    const Metrics metrics = metrics_of(trace);
    EXPECT_EQ(metrics.overshoot_m[0], 0.0);
    EXPECT_NEAR(*metrics.overshoot_m[1], 0.005, 1e-15);
    EXPECT_FALSE(metrics_of(resting(Task::t2, 2000)).overshoot_m[0]);
}

TEST(MetricsJson, ReadsBackExactly)
{
    Metrics metrics = metrics_of(pressing(123.456789, 80.1));
    metrics.task = Task::t6;
    metrics.drops = 1.0;
    metrics.response_s = 0.1 + 0.2;
    metrics.body_vibration_m[0] = ByOrder{.first = 1.0 / 3.0, .second = 5e-324, .fourth = 1.7e308};
    metrics.body_vibration_m[1].reset();
    for (const Metrics& written : {metrics, Metrics{}}) {
        const auto read = metrics_from(nlohmann::json::parse(to_json(written).dump()));
        ASSERT_TRUE(read);
        EXPECT_EQ(*read, written);
    }
}

TEST(MetricsJson, RefusesWhatIsSomethingElse)
{
    const nlohmann::json good = nlohmann::json::parse(to_json(Metrics{}).dump());
    ASSERT_TRUE(metrics_from(good));
    for (const auto& [key, value] : good.items()) {
        nlohmann::json wrong = good;
        wrong.erase(key);
        EXPECT_FALSE(metrics_from(wrong)) << key;
        wrong[key] = "P0";
        EXPECT_FALSE(metrics_from(wrong)) << key;
    }
    EXPECT_FALSE(metrics_from(nlohmann::json::array()));
}

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

TEST(Scores, OfASessionThatNeverBeganHaveNoTimeTogether)
{
    const Metrics perfect = metrics_of(resting(Task::t1, 1000));
    EXPECT_EQ(scores_of(metrics_of(Trace{.task = Task::t1}), perfect).scored_share, 0.0);
    EXPECT_EQ(scores_of(Metrics{}, Metrics{}).scored_share, 0.0);
}

} // namespace
} // namespace hapnet::lab
