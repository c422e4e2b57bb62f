// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/press_schedule.hpp"
#include "lab/metrics/json.hpp"
#include "lab/metrics/metrics.hpp"
#include "lab/metrics/scores.hpp"
#include "lab/virtual_time/play.hpp"
#include "scene/text/text.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

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

/// T2 with hands that press on ideal springs, at the frequency of each press; the resting hand
/// feels the same force as the pressing one.
Trace pressing(double left_n_per_m, double right_n_per_m)
{
    Trace trace = resting(Task::t2, 27000);
    constexpr double pi = 3.14159265358979323846;
    for (const device::PressInterval& press : device::press_schedule) {
        const std::size_t side = press.left_presses ? 0 : 1;
        const double stiffness = press.left_presses ? left_n_per_m : right_n_per_m;
        const long begin = std::lround(press.begin_s * 1e3);
        for (long i = begin; i < std::lround(press.end_s * 1e3); ++i) {
            const double turns = press.hertz * static_cast<double>(i - begin) * 1e-3;
            const double aim = 0.0035 * std::sin(2.0 * pi * turns);
            Sample& presser = trace.sides[side][static_cast<std::size_t>(i)];
            Sample& holder = trace.sides[1 - side][static_cast<std::size_t>(i)];
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
    // All but 0.75 s between the presses of either hand.
    EXPECT_NEAR(*metrics.contact_lost[0], 0.75 / 24.75, 1e-12);
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
        for (std::size_t i = 8000; i < 13500; ++i) side[i].body.value.y = 0.05;
    }
    EXPECT_EQ(metrics_of(trace).drops, 0.0);
    for (std::size_t i = 12000; i < 13500; ++i) trace.sides[1][i].body.value.y = 0.001;
    EXPECT_EQ(metrics_of(trace).drops, 1.0);
    EXPECT_EQ(metrics_of(resting(Task::t4, 27000)).drops, 1.0);
    EXPECT_FALSE(metrics_of(resting(Task::t4, 9000)).drops); // not played to the end
}

TEST(Metrics, SayHowFarABodyIsBeyondTheStaticCube)
{
    Trace trace = resting(Task::t1, 2000);
    trace.sides[1][1500].body.value.x = 0.0797;
    EXPECT_EQ(metrics_of(trace).overshoot_m[0], 0.0);
    EXPECT_NEAR(*metrics_of(trace).overshoot_m[1], 0.005, 1e-15);
    EXPECT_FALSE(metrics_of(resting(Task::t2, 2000)).overshoot_m[0]);
}

TEST(Metrics, TakeTheTasksToDoWhatTheirScriptsDo)
{
    for (const Task task : device::all_tasks) {
        Setting setting{.task = task, .seed = base::Seed{7}};
        const auto scene = scene::load_scene(std::string{device::scene_of(task)}, {});
        ASSERT_TRUE(scene) << scene.error().message;
        setting.scene = *scene;
        const auto trace = play(setting);
        ASSERT_TRUE(trace) << trace.error().message;
        const Metrics metrics = metrics_of(*trace);
        SCOPED_TRACE(device::name_of(task));
        EXPECT_GT(metrics.scored_s, 26.9);
        // T3's drag takes the leading hand off the cube.
        const double lost = task == Task::t3 ? 0.2 : 0.0;
        for (const auto& side : metrics.contact_lost) EXPECT_LE(side.value_or(0.0), lost);
        for (const auto& side : metrics.overshoot_m) EXPECT_LT(side.value_or(0.0), 1e-4);
        EXPECT_EQ(metrics.drops.value_or(0.0), 0.0);
        EXPECT_EQ(metrics.response_s.has_value(), task == Task::t6);
        EXPECT_EQ(metrics.stiffness_n_per_m[judged_press][1].has_value(), task == Task::t2);
        EXPECT_EQ(metrics.drag_n[0].has_value(),
                  task == Task::p1 || task == Task::t1 || task == Task::t3);
    }
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
    EXPECT_EQ(scores_of(metrics_of(Trace{.task = Task::t1}), perfect).scored_share, 0.0);
    EXPECT_EQ(scores_of(Metrics{}, Metrics{}).scored_share, 0.0);
}

} // namespace
} // namespace hapnet::lab
