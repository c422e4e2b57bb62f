// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/scene/compare.hpp"
#include "tests/bench/scene/precision.hpp"
#include "tests/bench/scene/reference.hpp"
#include "tests/bench/scene/stress.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::bench {
namespace {

/// An engine in which nothing ever moves: whatever it comes to must be found wrong.
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
        // Rest is what these ask for, and rest is all that it can do.
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
    const double expected = std::hypot(0.3, 2.0 - 9.81 / 2.0, 0.1); // where it should be by then
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
    // Up to the spring in 1.23 ms, half a period of sqrt(m/k) = 10 ms in it, back at its speed.
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

TEST(Limits, AreTheLastOfAnUnbrokenRow)
{
    constexpr std::array trials{1.0, 2.0, 4.0, 8.0};
    EXPECT_EQ(last_held(trials, [](double x) { return x != 4.0; }), 2.0);
    EXPECT_EQ(last_held(trials, [](double) { return true; }), 8.0);
    EXPECT_EQ(last_held(trials, [](double) { return false; }), 0.0);
}

TEST(WorkPrecision, DrawsAPanelForEachScenarioAndWritesALineForEachPoint)
{
    const std::vector<WorkPoint> points{{"a", "error_m", "hapnet", 4.0, 0.0, 10.0},
                                        {"a", "error_m", "hapnet", 2.0, 0.0, 20.0},
                                        {"b", "error_m", "hapnet", 4.0, 1e-3, 10.0}};
    const std::string svg = precision_svg(points);
    EXPECT_NE(svg.find("y='280' width='900'"), std::string::npos);
    EXPECT_EQ(svg.find("y='560'"), std::string::npos);
    EXPECT_EQ(precision_csv({points.data(), 1}),
              "scenario,metric,subject,tick_ms,error,ns_per_simulated_ms\n"
              "\"a\",error_m,hapnet,4,0,10\n");
}

TEST(WorkPrecision, TellsTheOrderOfAnErrorInTheTick)
{
    const std::vector<WorkPoint> points{{"a", "error_m", "hapnet", 4.0, 1e-15, 10.0},
                                        {"a", "error_m", "hapnet", 1.0, 2e-15, 20.0},
                                        {"a", "error_m", "ode-step", 4.0, 16.0, 10.0},
                                        {"a", "error_m", "ode-step", 1.0, 1.0, 10.0}};
    EXPECT_EQ(precision_markdown(points), "| case | metric | hapnet | ode-step |\n"
                                          "| --- | --- | ---: | ---: |\n"
                                          "| a | error_m | 2e-15 (exact) | 1 (2.0) |\n");
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

} // namespace
} // namespace hapnet::bench
