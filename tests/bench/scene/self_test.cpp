// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/scene/compare.hpp"
#include "tests/bench/scene/heaps.hpp"
#include "tests/bench/scene/overlap.hpp"
#include "tests/bench/scene/peers.hpp"
#include "tests/bench/scene/precision.hpp"
#include "tests/bench/scene/reference.hpp"
#include "tests/bench/scene/stress.hpp"
#include "tests/bench/scene/tails.hpp"
#include "tests/bench/scene/tumbling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <utility>

namespace hapnet::bench {
namespace {

/// An engine in which nothing ever moves: every scenario must find an error.
class Idle final : public Engine {
public:
    explicit Idle(const scene::Description& scene) : scene_{scene} {}
    void set_hand(std::uint32_t, const scene::HandInput&) override {}
    void step() override { ++steps; }
    [[nodiscard]] scene::BodyState state(scene::BodyId body) const override
    {
        const auto& one = scene_.bodies[body];
        return {one.position, one.orientation, one.velocity, one.angular_velocity};
    }
    [[nodiscard]] glm::dvec3 hip_force(std::uint32_t) const override { return glm::dvec3{0.0}; }

    static inline int steps = 0;

private:
    scene::Description scene_;
};

std::unique_ptr<Engine> make_idle(const scene::Description& scene, const EngineOptions&)
{
    return std::make_unique<Idle>(scene);
}

const Subject idle{"idle", own_family, false, make_idle};

/// An engine in which bodies fly straight on, through each other.
class Ghost final : public Engine {
public:
    Ghost(const scene::Description& scene, double tick_s) : scene_{scene}, tick_s_{tick_s} {}
    void set_hand(std::uint32_t, const scene::HandInput&) override {}
    void step() override { time_s_ += tick_s_; }
    [[nodiscard]] scene::BodyState state(scene::BodyId body) const override
    {
        const auto& one = scene_.bodies[body];
        const glm::dvec3 way = time_s_ * one.velocity.value;
        return {{one.position.value + way}, one.orientation, one.velocity, one.angular_velocity};
    }
    [[nodiscard]] glm::dvec3 hip_force(std::uint32_t) const override { return glm::dvec3{0.0}; }

private:
    scene::Description scene_;
    double tick_s_;
    double time_s_ = 0.0;
};

const Subject ghost{
    "ghost", "ode", false, [](const scene::Description& scene, const EngineOptions& options) {
        return std::unique_ptr<Engine>{std::make_unique<Ghost>(scene, options.tick_s)};
    }};

bool has_missed(const Scenario& scenario)
{
    Idle engine{scenario.course.scene};
    for (const Measure& measure : scenario.measure(engine, scenario.course, 1e-3)) {
        if (measure.target && !(measure.value <= *measure.target)) return true;
    }
    return false;
}

TEST(Scenarios, AreMissedByAnEngineThatDoesNothing)
{
    for (const Scenario& scenario : all_scenarios(true)) {
        // These scenarios ask for rest, which is all that the engine can do.
        if (scenario.reference == "itself") continue;
        const auto measures = [&] {
            Idle engine{scenario.course.scene};
            return scenario.measure(engine, scenario.course, 1e-3);
        }();
        const bool has_target = measures.front().target.has_value();
        if (has_target) {
            EXPECT_TRUE(has_missed(scenario)) << scenario.name;
        } else {
            EXPECT_GT(measures.front().value, 1e-4) << scenario.name;
        }
    }
}

TEST(Scenarios, TellHowFarAnEngineIsFromTheAnswer)
{
    const Scenario fall = ballistic();
    Idle engine{fall.course.scene};
    const double expected = std::hypot(0.3, 2.0 - 9.81 / 2.0, 0.1); // its true place by then
    EXPECT_DOUBLE_EQ(fall.measure(engine, fall.course, 1e-3)[0].value, expected);
    const Scenario stop = slide(45.0, scene::Turning::free);
    Idle still{stop.course.scene};
    EXPECT_DOUBLE_EQ(stop.measure(still, stop.course, 1e-3)[0].value, 1.0); // of the way
}

TEST(Reference, TurnsACubeByItsSpin)
{
    Course course{lone_cube(scene::Turning::free), 0.1, {}};
    course.scene.bodies[0].angular_velocity = {0.0, 3.0, 4.0};
    const auto end = reference_end(course);
    const glm::dquat expected{std::cos(0.25), 0.0, 0.6 * std::sin(0.25), 0.8 * std::sin(0.25)};
    EXPECT_LT(angle_between(end.orientation, expected), 1e-12);
}

TEST(Reference, ReturnsACubeFromASpringAfterHalfAPeriod)
{
    Scenario bouncing = bounce(1000.0, 0.0, scene::Turning::free);
    const auto end = reference_end(bouncing.course);
    // 1.23 ms to the spring, half a period of sqrt(m/k) = 10 ms in it, back at the same speed.
    const double half_period = 0.01 * std::acos(-1.0);
    EXPECT_NEAR(end.velocity.x(), 0.1, 1e-10);
    EXPECT_NEAR(end.position.x(), 0.1 * (0.05 - 2.0 * 1.23e-3 - half_period), 1e-10);
}

TEST(Race, BeginsAgainWhenTheCourseEndsAndTimesNobodyWhoCannotRun)
{
    const Subject absent{
        "absent", "ode", false,
        [](const scene::Description&, const EngineOptions&) { return std::unique_ptr<Engine>{}; }};
    const Course course{lone_cube(scene::Turning::free), 0.1, {}};
    const std::array contenders{Contender{&idle, {}}, Contender{&absent, {}}};
    Idle::steps = 0;
    const auto medians = race(course, contenders, 1e-4);
    EXPECT_GT(Idle::steps, 100);
    EXPECT_GT(medians[0], 0.0);
    EXPECT_TRUE(std::isnan(medians[1]));
}

TEST(Compare, SetsHapnetAgainstTheBestOfEachFamily)
{
    const std::vector<Reading> readings{{"hapnet", own_family, 10.0},
                                        {"bullet", "bullet", 150.0},
                                        {"bullet-double", "bullet", 120.0},
                                        {"ode-step", "ode", 90.0}};
    const auto rows = compare({"case", "", "p50_ns", 20.0, 10.0}, readings);
    ASSERT_EQ(rows.size(), 6U);
    EXPECT_EQ(rows[0].met(), true);
    EXPECT_EQ(rows[1].met(), std::nullopt);
    EXPECT_EQ(rows[4].baseline, "bullet");
    EXPECT_EQ(rows[4].ratio(), 12.0);
    EXPECT_EQ(rows[4].met(), true);
    EXPECT_EQ(rows[5].baseline, "ode");
    EXPECT_EQ(rows[5].met(), false); // 9 and not 10
    const std::string tables = markdown(rows);
    EXPECT_NE(tables.find("| case | p50_ns | 10 | 150 | 120 | 90 | ≤ 20, ≥ 10x | "
                          "bullet 12x, ode 9x **missed** |"),
              std::string::npos)
        << tables;
    EXPECT_EQ(misses(rows), "- case, p50_ns: ode is 9 times as much, target ≥ 10\n");
}

TEST(Compare, SaysWhereAPeerIsBetterAndThatNothingBeatsNothing)
{
    const std::vector<Reading> worse{{"hapnet", own_family, 2.0}, {"mujoco", "mujoco", 1.0}};
    const auto lost = compare({"case", "", "gain_j", {}, 1.0}, worse).back();
    EXPECT_EQ(lost.baseline, "mujoco");
    EXPECT_EQ(lost.ratio(), 0.5);
    EXPECT_EQ(lost.met(), false);
    for (const double peer : {0.0, 1.0}) {
        const std::vector<Reading> none{{"hapnet", own_family, 0.0}, {"mujoco", "mujoco", peer}};
        EXPECT_EQ(compare({"case", "", "gain_j", {}, 1.0}, none).back().met(), true) << peer;
    }
}

TEST(Entries, HaveAFinerIntegratorInFlightAndTheScenariosOptions)
{
    const std::array all{Subject{"mujoco", "mujoco", false, make_idle, true}};
    EXPECT_EQ(entries_of(steady_push(scene::Turning::free), all).size(), 1U);
    const auto entries = entries_of(ballistic(), all);
    ASSERT_EQ(entries.size(), 2U);
    EXPECT_EQ(entries[1].name, "mujoco rk4");
    EXPECT_EQ(entries[1].options.integrator, Integrator::rk4);
    EXPECT_EQ(entries_of(stack_in_long_ticks(), all)[0].options.tick_s, 16e-3);
    EXPECT_TRUE(entries_of(steady_push_on_own_plane(), all)[0].options.has_own_planes);
}

TEST(Orientations, AreUnitAndApart)
{
    constexpr int count = 64;
    for (int i = 0; i < count; ++i) {
        EXPECT_NEAR(glm::length(even_turn(i, count)), 1.0, 1e-12);
        for (int j = 0; j < i; ++j) {
            EXPECT_GT(angle_between(even_turn(i, count), even_turn(j, count)), 0.3);
        }
    }
}

TEST(Overlap, IsTheShortestWayApart)
{
    scene::Description scene = lone_cube(scene::Turning::free);
    scene.bodies.push_back(cube());
    scene.bodies[1].position = {{0.039, 0.01, 0.0}};
    EXPECT_NEAR(deepest_overlap(scene, Idle{scene}), 0.001, 1e-15);
    scene.bodies[1].position = {{0.041, 0.0, 0.0}};
    EXPECT_EQ(deepest_overlap(scene, Idle{scene}), 0.0);
    // An edge of each box crosses an edge of the other, along the diagonals of their faces.
    const double turn = std::acos(-1.0) / 8.0;
    scene.bodies[0].orientation = {std::cos(turn), 0.0, 0.0, std::sin(turn)};
    scene.bodies[1].orientation = {std::cos(turn), 0.0, std::sin(turn), 0.0};
    scene.bodies[1].position = {{0.04 * std::sqrt(2.0) - 0.002, 0.0, 0.0}};
    EXPECT_NEAR(deepest_overlap(scene, Idle{scene}), 0.002, 1e-15);
    scene.planes = {platform()};
    EXPECT_NEAR(deepest_overlap(scene, Idle{scene}), 0.02 * (std::sqrt(2.0) - 1.0), 1e-15);
}

TEST(Heaps, BeginWithNothingInsideAnything)
{
    for (const Course& course :
         {bin(50, 0.3), bin(200, 0.3), brick_wall(10.0), dominoes(), pyramid()}) {
        const Idle engine{course.scene};
        EXPECT_LT(deepest_overlap(course.scene, engine), 1e-15) << course.scene.bodies.size();
    }
}

/// Returns how often Hapnet's guards act in some courses.
std::uint64_t guards_in(std::span<const Course> courses)
{
    const std::uint64_t before = hapnet_guards();
    for (const Course& course : courses) run(*make_hapnet(course.scene, {}), course, 1e-3);
    return hapnet_guards() - before;
}

TEST(Guards, ActInNoScenarioOfTheBench)
{
    std::vector<Course> courses{tumbling_box(0.0), tumbling_box(0.4), tumbling_box(2.0), top(),
                                ledge()};
    for (const Scenario& one : all_scenarios(true)) courses.push_back(one.course);
    EXPECT_EQ(guards_in(courses), 0U);
}

TEST(Guards, ActInNoHeapOfTheBench)
{
    const std::array courses{bin(50, 0.3), bin(200, 0.3), brick_wall(10.0), brick_wall(40.0),
                             dominoes(),   pyramid(),     stiff_hands()};
    EXPECT_EQ(guards_in(courses), 0U);
}

TEST(Heaps, OverlapLessThanThoseOfTheEngines)
{
    const Course course = bin(200, 0.3);
    // Over the last tenth of a second, because single ticks vary by chance.
    const auto deepest_and_late = [&](Engine& engine) {
        double deepest = 0.0, late = 0.0;
        run(engine, course, 1e-3, [&](double time_s) {
            const double overlap = deepest_overlap(course.scene, engine);
            deepest = std::max(deepest, overlap);
            if (time_s > course.duration_s - 0.1) late += overlap;
        });
        return std::pair{deepest, late};
    };
    const auto [deepest, late] = deepest_and_late(*make_hapnet(course.scene, {}));
    for (const Subject& subject : subjects()) {
        // The other engines take many times as long.
        if (subject.name != "bullet" && subject.name != "ode-quick") continue;
        const auto engine = subject.make(course.scene, {});
        const auto its = deepest_and_late(*engine);
        EXPECT_LT(deepest, its.first) << subject.name;
        EXPECT_LT(late, its.second) << subject.name;
    }
}

TEST(Tails, TakeTheLeastOfEveryStepAndTheShareOfThem)
{
    const Course course{lone_cube(scene::Turning::free), 0.1, {}};
    const Subject absent{
        "absent", "ode", false,
        [](const scene::Description&, const EngineOptions&) { return std::unique_ptr<Engine>{}; }};
    const std::array contenders{Contender{&idle, {}}, Contender{&absent, {}}};
    const auto times = least_times(course, contenders, 3);
    EXPECT_EQ(times[0].size(), 100U);
    EXPECT_TRUE(times[1].empty());
    EXPECT_EQ(quantile({3.0, 1.0, 2.0}, 0.5), 2.0);
    EXPECT_EQ(quantile({3.0, 1.0, 2.0}, 1.0), 3.0);
    const std::array entries{Entry{"idle", &idle, {}}, Entry{"absent", &absent, {}}};
    const auto rows = tails_of(course, entries, {"case", "", "", 0.0}, 1);
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(rows[1].metric, "p99_ns");
    EXPECT_EQ(rows[1].met(), std::nullopt);
    EXPECT_EQ(rows[2].metric, "worst_ns");
    EXPECT_EQ(rows[2].met(), false); // it took some time
}

TEST(Tumbling, SumsWhatABodyGainsAndNotWhatItLoses)
{
    Course course = tumbling_box(0.0);
    course.scene.bodies[0].velocity = {{0.0, 1.0, 0.0}};
    Ghost rising{course.scene, 1e-3};
    EXPECT_NEAR(energy_gain(rising, course, 1e-3), 0.1 * 9.81 * 1.0, 1e-12); // m g h after 1 s
    course.scene.bodies[0].velocity = {{0.0, -1.0, 0.0}};
    Ghost falling{course.scene, 1e-3};
    EXPECT_EQ(energy_gain(falling, course, 1e-3), 0.0);
}

TEST(TurnedCubes, PassWhereNothingStopsThem)
{
    const std::array both{idle, ghost};
    for (const Row& row : turned_cubes(both)) {
        if (row.metric.ends_with("_ratio")) continue;
        EXPECT_EQ(row.value, row.subject == "ghost" ? 256.0 : 0.0) << row.name;
    }
}

TEST(Limits, AreTheLastOfAnUnbrokenRow)
{
    constexpr std::array trials{1.0, 2.0, 4.0, 8.0};
    EXPECT_EQ(last_held(trials, [](double x) { return x != 4.0; }), 2.0);
    EXPECT_EQ(last_held(trials, [](double) { return true; }), 8.0);
    EXPECT_EQ(last_held(trials, [](double) { return false; }), 0.0);
}

TEST(WorkPrecision, WritesALineForEachPoint)
{
    const std::vector<WorkPoint> points{{"a", "error_m", "hapnet", 4.0, 0.0, 10.0},
                                        {"b", "error_m", "ode", 2.0, 0.5, 20.0}};
    EXPECT_EQ(precision_csv(points), "scenario,metric,subject,tick_ms,error,ns_per_simulated_ms\n"
                                     "\"a\",error_m,hapnet,4,0,10\n"
                                     "\"b\",error_m,ode,2,0.5,20\n");
}

TEST(WorkPrecision, TellsTheOrderOfAnErrorInTheTick)
{
    const std::vector<WorkPoint> points{{"a", "error_m", "hapnet", 4.0, 1e-15, 10.0},
                                        {"a", "error_m", "hapnet", 1.0, 2e-15, 20.0},
                                        {"a", "error_m", "ode-step", 4.0, 16.0, 10.0},
                                        {"a", "error_m", "ode-step", 1.0, 1.0, 10.0},
                                        {"b", "error_m", "ode-step", 4.0, 4.0, 10.0},
                                        {"b", "error_m", "ode-step", 1.0, 1.0, 10.0}};
    EXPECT_EQ(precision_markdown(points), "| case | metric | hapnet | ode-step |\n"
                                          "| --- | --- | ---: | ---: |\n"
                                          "| a | error_m | 2e-15 (exact) | 1 (2.0) |\n"
                                          "| b | error_m | – | 1 (1.0) |\n");
}

TEST(Peers, FallWhereTheySayTheyAre)
{
    const Scenario fall = ballistic();
    for (const Subject& subject : subjects()) {
        const auto engine = subject.make(fall.course.scene, {});
        ASSERT_TRUE(engine) << subject.name;
        // First order: g h t / 2 at 1 ms.
        EXPECT_LT(fall.measure(*engine, fall.course, 1e-3)[0].value, 5e-3) << subject.name;
    }
}

TEST(Peers, StartWhereTheSceneSays)
{
    scene::Description scene = lone_cube(scene::Turning::free);
    scene::BodyDescription& body = scene.bodies[0];
    body.position = {{0.1, 0.2, 0.3}};
    body.orientation = even_turn(5, 16);
    body.velocity = {{1.0, 2.0, 3.0}};
    body.angular_velocity = {4.0, 5.0, 6.0};
    for (const Subject& subject : subjects()) {
        const auto engine = subject.make(scene, {});
        ASSERT_TRUE(engine) << subject.name;
        const scene::BodyState state = engine->state(0);
        constexpr double rounding = 1e-5; // in single precision
        EXPECT_LT(glm::length((state.position - body.position).value), rounding) << subject.name;
        EXPECT_LT(angle_between(state.orientation, body.orientation), rounding) << subject.name;
        EXPECT_LT(glm::length(state.velocity.value - body.velocity.value), rounding);
        EXPECT_LT(glm::length(state.angular_velocity - body.angular_velocity), rounding);
    }
}

TEST(Peers, AreSlowedDownByDragOnTheirPlane)
{
    scene::Description scene = lone_cube(scene::Turning::locked);
    scene.gravity = {0.0, -9.81, 0.0};
    scene.planes = {platform()};
    scene.planes[0].material.friction = scene.bodies[0].material.friction = 0.0;
    scene.bodies[0].velocity = {{0.1, 0.0, 0.1}};
    scene.bodies[0].drag_ns_per_m = 1.0;
    for (const Subject& subject : subjects()) {
        const auto engine = subject.make(scene, {});
        run(*engine, {scene, 0.1, {}}, 1e-3);
        const glm::dvec3 v = engine->state(0).velocity.value;
        EXPECT_NEAR(v.x, 0.1 * std::exp(-1.0), 5e-4) << subject.name; // m / drag is 0.1 s
        EXPECT_NEAR(v.z, v.x, 1e-6) << subject.name;
        EXPECT_NEAR(engine->state(0).position.y(), 0.0, 1e-5) << subject.name;
    }
}

TEST(Peers, FeelAHandThatPushesThem)
{
    for (const auto turning : {scene::Turning::locked, scene::Turning::free}) {
        const Scenario push = steady_push(turning);
        for (const Subject& subject : subjects()) {
            const auto engine = subject.make(push.course.scene, {});
            const double error = push.measure(*engine, push.course, 1e-3)[0].value;
            EXPECT_LT(error, 0.1) << subject.name; // of the friction
        }
    }
}

TEST(Peers, PlayEveryElementThatTheyHave)
{
    for (const Scenario& scenario : element_scenarios()) {
        Idle nothing{scenario.course.scene};
        const double missed = scenario.measure(nothing, scenario.course, 1e-3)[0].value;
        for (const Subject& subject : subjects()) {
            const auto engine = subject.make(scenario.course.scene, {});
            if (!engine) {
                EXPECT_EQ(subject.name, "mujoco") << scenario.name; // no kinematic bodies
                continue;
            }
            // The tolerance is a share of the motion, because ODE's friction is not a circle.
            const double error = scenario.measure(*engine, scenario.course, 1e-3)[0].value;
            EXPECT_LT(error, 0.35 * missed) << scenario.name << ": " << subject.name;
        }
    }
}

TEST(Peers, RepeatARunToTheBit)
{
    Course course = bin(20, 0.3);
    course.duration_s = 0.3;
    for (const Subject& subject : subjects()) {
        const auto end = [&] {
            const auto engine = subject.make(course.scene, {});
            run(*engine, course, 1e-3);
            return engine->state(7).position;
        };
        const base::Position once = end();
        const glm::dvec3 moved = (once - course.scene.bodies[7].position).value;
        EXPECT_GT(glm::length(moved), 1e-3) << subject.name;
        EXPECT_EQ(end().value, once.value) << subject.name;
    }
}

} // namespace
} // namespace hapnet::bench
