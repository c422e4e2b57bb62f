// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/metrics.hpp"

#include "lab/metrics/scores.hpp"
#include "scene/text/text.hpp"
#include "tests/unit/lab/metrics/made_traces.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::lab::metrics {
namespace {

using device::Task;

TEST(Metrics, OfNothingAreNone)
{
    EXPECT_EQ(metrics_of(virtual_time::Trace{.task = Task::t3}), Metrics{.task = Task::t3});
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
    EXPECT_EQ(metrics.force_above_2hz_n[0], ByOrder{});
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
    // All of the time except 0.75 s between the presses of either hand.
    EXPECT_NEAR(*metrics.contact_lost[0], 0.75 / 24.75, 1e-12);
}

TEST(Metrics, SeeASlowTugOfWarAbove2HzAndNotAbove20)
{
    // 0.5 N at 4 Hz on L's hand, beside a constant force of 1 N, for 60 s, of which half a second
    // does not count. The gain is that of an analogue Butterworth filter at 4 Hz over 2 Hz.
    virtual_time::Trace trace = resting(Task::t3, 60500);
    constexpr double pi = 3.14159265358979323846, hertz = 4.0, newtons = 0.5;
    for (std::size_t i = 0; i < trace.sides[0].size(); ++i) {
        const double turns = hertz * static_cast<double>(i) * 1e-3;
        trace.sides[0][i].on_hand.value.x = 1.0 + newtons * std::sin(2.0 * pi * turns);
    }
    const Metrics metrics = metrics_of(trace);
    const auto& slow = metrics.force_above_2hz_n[0];
    ASSERT_TRUE(slow);
    const double rms = newtons / std::sqrt(2.0);
    EXPECT_NEAR(slow->first, rms / std::sqrt(1.0 + 1.0 / 4.0), 2e-3);
    EXPECT_NEAR(slow->second, rms / std::sqrt(1.0 + 1.0 / 16.0), 2e-3);
    EXPECT_NEAR(slow->fourth, rms / std::sqrt(1.0 + 1.0 / 256.0), 2e-3);
    EXPECT_NEAR(metrics.force_vibration_n[0]->first, rms / std::sqrt(1.0 + 25.0), 2e-3);
    EXPECT_LT(metrics.force_vibration_n[0]->fourth, 1e-3);
    EXPECT_EQ(metrics.force_above_2hz_n[1], ByOrder{}) << "the other hand feels nothing";
    // Against the same hand with 0.3 N on a perfect network the rest is in quadrature: 0.4 N.
    Metrics perfect = metrics;
    for (double* order :
         {&perfect.force_above_2hz_n[0]->first, &perfect.force_above_2hz_n[0]->second,
          &perfect.force_above_2hz_n[0]->fourth})
        *order *= 0.6;
    EXPECT_NEAR(scores_of(metrics, perfect).force_above_2hz_added_n->first, 0.8 * slow->first,
                1e-12);
}

TEST(Metrics, CountVibrationByTurnsOnlyWhereASideFollows)
{
    virtual_time::Trace trace = resting(Task::t1, 10000);
    for (std::size_t i = 0; i < 10000; ++i) {
        virtual_time::Sample& left = trace.sides[0][i];
        virtual_time::Sample& right = trace.sides[1][i];
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
    virtual_time::Trace trace = resting(Task::p1, 5000);
    trace.begin = base::Duration{1'082'000'000};
    for (virtual_time::Sample& sample : trace.sides[1]) sample.remote_touching = true;
    for (auto& side : trace.sides) {
        for (virtual_time::Sample& sample : side) sample.body.value.x = 0.07;
    }
    trace.sides[1][0].body.value.x = 0.0;
    const Metrics metrics = metrics_of(trace);
    EXPECT_EQ(metrics.discrepancy_m->max, 0.07);
    EXPECT_EQ(metrics.body_vibration_m[1], ByOrder{});
}

TEST(Metrics, KnowADroppedBodyFromOneThatIsHeld)
{
    virtual_time::Trace trace = resting(Task::t4, 27000);
    for (auto& side : trace.sides) {
        for (std::size_t i = 8000; i < 13500; ++i) side[i].body.value.y = 0.05;
    }
    EXPECT_EQ(metrics_of(trace).drops, 0.0);
    for (std::size_t i = 12000; i < 13500; ++i) trace.sides[1][i].body.value.y = 0.001;
    EXPECT_EQ(metrics_of(trace).drops, 1.0);
    EXPECT_EQ(metrics_of(resting(Task::t4, 27000)).drops, 1.0);
    EXPECT_FALSE(metrics_of(resting(Task::t4, 9000)).drops); // it ends too early
}

TEST(Metrics, SayHowFarABodyIsBeyondTheStaticCube)
{
    virtual_time::Trace trace = resting(Task::t1, 2000);
    trace.sides[1][1500].body.value.x = 0.0797;
    EXPECT_EQ(metrics_of(trace).overshoot_m[0], 0.0);
    EXPECT_NEAR(*metrics_of(trace).overshoot_m[1], 0.005, 1e-15);
    EXPECT_FALSE(metrics_of(resting(Task::t2, 2000)).overshoot_m[0]);
}

TEST(Metrics, OfMoreThanTwoAreThoseOfTheWorstPairAndOfTheWorstOfARole)
{
    virtual_time::Trace trace = resting(Task::t7, 2000);
    trace.sides.resize(4, trace.sides.front());
    for (std::size_t i = 0; i < 2000; ++i) {
        trace.sides[1][i].body.value.x = 0.001;
        trace.sides[3][i].body.value.x = -0.002;
        trace.sides[2][i].on_hand.value.x = i % 2 == 0 ? 0.1 : -0.1;
    }
    const Metrics metrics = metrics_of(trace);
    EXPECT_NEAR(metrics.discrepancy_m->mean, 0.003, 1e-15);
    EXPECT_NEAR(metrics.force_steps[0]->largest_n, 0.2, 1e-15); // the third counts like the first
    EXPECT_EQ(metrics.force_steps[1]->largest_n, 0.0);
    EXPECT_FALSE(metrics.turned_apart_rad);
}

TEST(Metrics, OfABodyThatTurnsSayTheAngleBetweenItsCopies)
{
    virtual_time::Trace trace = resting(Task::t3, 1000);
    for (std::size_t i = 500; i < 1000; ++i) {
        trace.sides[0][i].orientation = glm::dquat{std::cos(0.05), 0.0, std::sin(0.05), 0.0};
        trace.sides[1][i].orientation = glm::dquat{-1.0, 0.0, 0.0, 0.0}; // not turned
    }
    const auto apart = metrics_of(trace).turned_apart_rad;
    ASSERT_TRUE(apart);
    EXPECT_NEAR(apart->max, 0.1, 1e-15);
    EXPECT_NEAR(apart->mean, 0.05, 1e-12);
    EXPECT_EQ(apart->min, 0.0);
}

TEST(Metrics, OfSeveralBodiesAreThoseOfTheOneThatIsFarthestApart)
{
    virtual_time::Trace trace = resting(Task::t9, 1000);
    trace.further_bodies = 2;
    trace.further.assign(2, std::vector<virtual_time::Pose>(2000));
    for (std::size_t i = 0; i < 1000; ++i) {
        trace.sides[0][i].body.value.x = 0.001;
        trace.further[1][2 * i].position.value.x = -0.004;
        trace.further[1][2 * i + 1].orientation =
            glm::dquat{std::cos(0.001 * static_cast<double>(i)), 0.0, 0.0,
                       std::sin(0.001 * static_cast<double>(i))};
    }
    const Metrics metrics = metrics_of(trace);
    EXPECT_NEAR(metrics.discrepancy_m->mean, 0.004, 1e-15);
    ASSERT_TRUE(metrics.turned_apart_rad);
    EXPECT_NEAR(metrics.turned_apart_rad->max, 2.0 * 0.999, 1e-12);
}

TEST(Metrics, OfSeveralBodiesSayForEachHowFarItsCopiesAreApart)
{
    virtual_time::Trace trace = resting(Task::t9, 1000);
    trace.further_bodies = 1;
    trace.further.assign(2, std::vector<virtual_time::Pose>(1000));
    for (std::size_t i = 0; i < 1000; ++i) {
        trace.sides[0][i].body.value = {0.003, 0.004, 0.0};
        trace.further[1][i].orientation =
            glm::dquat{std::cos(5e-4 * static_cast<double>(i)),
                       std::sin(5e-4 * static_cast<double>(i)), 0.0, 0.0};
    }
    trace.settled = {{1e-5, 2e-5}, {3e-5, 4e-5}};
    const auto bodies = metrics_of(trace).bodies;
    ASSERT_EQ(bodies.size(), 2U);
    EXPECT_NEAR(bodies[0].discrepancy_x_m->mean, 0.003, 1e-15);
    EXPECT_NEAR(bodies[0].discrepancy_m->mean, 0.005, 1e-15);
    EXPECT_FALSE(bodies[0].turned_apart_rad);
    EXPECT_EQ(bodies[0].settled_m, 1e-5);
    EXPECT_FALSE(bodies[0].settled_rad) << "it never turned";
    EXPECT_EQ(bodies[1].discrepancy_m->max, 0.0);
    EXPECT_NEAR(bodies[1].turned_apart_rad->max, 0.999, 1e-12);
    EXPECT_EQ(bodies[1].settled_rad, 4e-5);
}

TEST(Metrics, OfATaskWithBodiesThatTurnSayThatTheCopiesAgreeAfterHandsOff)
{
    for (const Task task : {Task::t8, Task::t9, Task::t10}) {
        virtual_time::Setting setting{.task = task, .seed = base::Seed{7}};
        setting.scene = scene::load_scene(std::string{device::scene_of(task)}, {}).value();
        emulator::Conditions conditions;
        conditions.delay = emulator::constant(std::chrono::milliseconds{40});
        setting.profile.path = {conditions, conditions};
        const auto trace = play(setting);
        ASSERT_TRUE(trace) << trace.error().message;
        const auto bodies = metrics_of(*trace).bodies;
        EXPECT_EQ(bodies.size(), task == Task::t8 ? 1U : 3U);
        for (const BodyApart& body : bodies) {
            EXPECT_LE(body.settled_m.value_or(1.0), 1e-4) << device::name_of(task);
            EXPECT_LE(body.settled_rad.value_or(0.0), 1e-4) << device::name_of(task);
        }
    }
}

TEST(Metrics, TakeTheTasksToDoWhatTheirScriptsDo)
{
    for (const Task task : device::all_tasks) {
        virtual_time::Setting setting{.task = task, .seed = base::Seed{7}};
        const auto scene = scene::load_scene(std::string{device::scene_of(task)}, {});
        ASSERT_TRUE(scene) << scene.error().message;
        setting.scene = *scene;
        const auto trace = play(setting);
        ASSERT_TRUE(trace) << trace.error().message;
        const Metrics metrics = metrics_of(*trace);
        SCOPED_TRACE(device::name_of(task));
        EXPECT_GT(metrics.scored_s, 26.9);
        // The drag pulls their leading hand off the cube.
        const bool squeezes = task == Task::t3 || task == Task::t7; // equal for two hands
        const double lost = squeezes ? 0.2 : 0.0;
        for (const auto& side : metrics.contact_lost) EXPECT_LE(side.value_or(0.0), lost);
        for (const auto& side : metrics.overshoot_m) EXPECT_LT(side.value_or(0.0), 1e-4);
        EXPECT_EQ(metrics.drops.value_or(0.0), 0.0);
        EXPECT_EQ(metrics.response_s.has_value(), task == Task::t6);
        EXPECT_EQ(metrics.stiffness_n_per_m[judged_press][1].has_value(), task == Task::t2);
        EXPECT_EQ(metrics.drag_n[0].has_value(), task == Task::p1 || task == Task::t1 || squeezes);
    }
}

} // namespace
} // namespace hapnet::lab::metrics
