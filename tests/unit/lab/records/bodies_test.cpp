// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/bodies.hpp"

#include "lab/records/analysis_report.hpp"
#include "lab/records/csv.hpp"
#include "lab/records/curves.hpp"
#include "lab/records/recorded_trace.hpp"
#include "tests/unit/lab/records/recording.hpp"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <string>
#include <utility>

namespace hapnet::lab::records {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

glm::dquat turned(double radians)
{
    return {std::cos(0.5 * radians), 0.0, std::sin(0.5 * radians), 0.0};
}

/// Body 0 lies still, and body 2 is displaced by `offset` metres along z and `angle`.
Recording with_two_bodies(int peer_id, double offset, double angle)
{
    Recording recording{peer_id};
    recording.session(5s).ticks(0s, 2s, Phase::running).ticks(2s, 5s, Phase::hands_off);
    recording.bodies({0, 2}, [&](record::BodyRow& row, base::Duration time) {
        if (row.body == 0) return;
        // A tenth remains after the hands let go.
        const double share = time < 2s ? 1.0 : 0.1;
        row.position = {{0.0, 0.0, share * offset}};
        row.orientation = turned(share * angle);
    });
    return recording;
}

Recording first() { return with_two_bodies(1, 0.0, 0.0); }
Recording second() { return with_two_bodies(2, 0.010, 20.0 * degree); }

TEST(Bodies, OfASessionAreComparedEachOnItsOwn)
{
    auto a = first(), b = second();
    const Agreement agreement = analysis_of(a, b).agreement;
    ASSERT_EQ(agreement.bodies.size(), 2U);
    EXPECT_EQ(agreement.bodies[0].discrepancy->max, 0.0);
    EXPECT_EQ(agreement.bodies[1].body.number, 2);
    EXPECT_NEAR(agreement.bodies[1].discrepancy->mean, 0.010, 1e-15);
    EXPECT_EQ(agreement.bodies[1].discrepancy_x->max, 0.0) << "it is along z";
    EXPECT_NEAR(agreement.bodies[1].turned_apart->mean, 20.0 * degree, 1e-12);
    EXPECT_NEAR(*agreement.settled_discrepancy, 0.001, 1e-15) << "of the worst body";
    EXPECT_NEAR(*agreement.settled_turned_apart, 2.0 * degree, 1e-12);
}

TEST(Bodies, AreTakenBetweenTheTicksOfBAlsoInTheirAngle)
{
    Recording a{1};
    a.session(1s).ticks(1ms, 2ms).bodies(
        {0}, [](record::BodyRow& row, base::Duration) { row.orientation = turned(0.003); });
    Recording b{2};
    b.session(1s).ticks(0s, 3ms, Phase::running, [](record::TickRow& row, base::Duration) {
        row.late = 500us; // so that A's tick lies in the middle of two
    });
    b.bodies({0}, [](record::BodyRow& row, base::Duration time) {
        row.orientation = turned(0.010 * base::to_seconds(time) / 0.001);
    });
    const Agreement agreement = analysis_of(a, b).agreement;
    EXPECT_NEAR(agreement.bodies[0].turned_apart->max, 0.005 - 0.003, 1e-9);
}

TEST(Bodies, OfWhichARowIsLostAreNotComparedThere)
{
    auto a = first(), b = second();
    auto& rows = b.content().bodies;
    std::erase_if(rows, [](const auto& row) { return row.body == 2 && row.tick < 1999; });
    const Agreement agreement = analysis_of(a, b).agreement;
    EXPECT_NEAR(agreement.bodies[1].discrepancy->mean, 0.010, 1e-15);
    EXPECT_EQ(agreement.bodies[1].discrepancy->std, 0.0) << "one moment is left";
    EXPECT_NEAR(*agreement.settled_discrepancy, 0.001, 1e-15);
}

TEST(Bodies, HaveTheirNamesAndFreedomFromTheScene)
{
    auto a = first(), b = second();
    a.content().config["scene_toml"] =
        "[[body]]\nname = \"sled\"\nsize = \"60mm\"\nmass = \"0.1kg\"\nturning = \"locked\"\n"
        "[[body]]\nfixed = true\nsize = \"60mm\"\n"
        "[[body]]\nsize = \"60mm\"\nmass = \"0.1kg\"\n";
    const Agreement agreement = analysis_of(a, b).agreement;
    EXPECT_EQ(name_of(agreement.bodies[0].body), "sled");
    EXPECT_FALSE(agreement.bodies[0].turned_apart);
    EXPECT_EQ(name_of(agreement.bodies[1].body), "body 3");
    EXPECT_TRUE(agreement.bodies[1].turned_apart);
}

/// While both hands are on, peer `first` owns the body for the first second, then peer 2 does.
Recording owned(int peer_id, std::uint16_t first_owner)
{
    Recording recording{peer_id};
    recording.session(5s).ticks(0s, 2s, Phase::running).ticks(2s, 5s, Phase::hands_off);
    recording.bodies({0}, [&](record::BodyRow& row, base::Duration time) {
        row.owner = time < 1s ? first_owner : std::uint16_t{2};
    });
    return recording;
}

TEST(Bodies, AreHandedOverAsOftenAsTheirOwnerChangesOnTheSideThatSawMoreOfIt)
{
    auto a = owned(1, 1), b = owned(2, 2);
    const Analysis analysis = analysis_of(a, b);
    const BodyAgreement& body = analysis.agreement.bodies[0];
    EXPECT_EQ(body.handovers, 1U);
    EXPECT_NEAR(*body.same_owner, 0.5, 1e-3);
    const nlohmann::json report = to_json(analysis);
    EXPECT_EQ(report["bodies"]["0"]["handovers"], 1);
    EXPECT_NEAR(report["bodies"]["0"]["same_owner"].get<double>(), 0.5, 1e-3);
    for (record::BodyRow& row : a.content().bodies) row.owner = 0;
    EXPECT_EQ(analysis_of(a, b).agreement.bodies[0].handovers, 0U);
    for (record::BodyRow& row : b.content().bodies) row.owner = 0; // as in version 4
    const nlohmann::json unsaid = to_json(analysis_of(a, b));
    EXPECT_TRUE(unsaid["bodies"]["0"]["handovers"].is_null());
    EXPECT_TRUE(unsaid["bodies"]["0"]["same_owner"].is_null());
}

TEST(Bodies, StandInTheAnalysisForProgramsAndForPeople)
{
    auto a = first(), b = second();
    const Analysis analysis = analysis_of(a, b);
    const nlohmann::json report = to_json(analysis);
    EXPECT_NEAR(report["bodies"]["2"]["discrepancy_mm"]["mean"].get<double>(), 10.0, 1e-9);
    EXPECT_NEAR(report["bodies"]["2"]["turned_apart_deg"]["max"].get<double>(), 20.0, 1e-9);
    EXPECT_NEAR(report["bodies"]["2"]["settled_turned_apart_deg"].get<double>(), 2.0, 1e-9);
    EXPECT_EQ(report["bodies"]["0"]["discrepancy_mm"]["max"], 0.0);
    EXPECT_NEAR(report["settled_discrepancy_mm"].get<double>(), 1.0, 1e-9);
    EXPECT_NEAR(report["settled_turned_apart_deg"].get<double>(), 2.0, 1e-9);
    const std::string text = to_table(analysis);
    EXPECT_NE(text.find("\nbody 3 "), std::string::npos) << text;
}

TEST(Bodies, OfACircleAreThoseOfTheWorstPair)
{
    Recording c = with_two_bodies(3, -0.005, 0.0);
    const auto of = [](Recording recording, std::uint16_t other_a, std::uint16_t other_b,
                       std::uint32_t session_a, std::uint32_t session_b) {
        record::Record record = recording.content();
        record.sessions.clear();
        record.ticks_before_session = {0, 0};
        record.sessions.push_back(
            {.start = start, .length = 5s, .session = session_a, .other = other_a});
        record.sessions.push_back(
            {.start = start, .length = 5s, .session = session_b, .other = other_b});
        return record;
    };
    const std::vector<record::Record> records{of(first(), 2, 3, 12, 13), of(second(), 1, 3, 12, 23),
                                              of(c, 1, 2, 13, 23)};
    const auto circle = analyse_circle(records);
    ASSERT_TRUE(circle) << circle.error().message;
    const nlohmann::json report = to_json(*circle);
    EXPECT_NEAR(report["bodies"]["2"]["discrepancy_mm"]["mean"].get<double>(), 15.0, 1e-9);
    EXPECT_NEAR(report["bodies"]["2"]["turned_apart_deg"]["mean"].get<double>(), 20.0, 1e-9);
    EXPECT_NEAR(report["pairs"]["1-3"]["bodies"]["2"]["discrepancy_mm"]["mean"].get<double>(), 5.0,
                1e-9);
    EXPECT_NEAR(report["settled_discrepancy_mm"].get<double>(), 1.5, 1e-9);
    EXPECT_NEAR(report["settled_turned_apart_deg"].get<double>(), 2.0, 1e-9);
}

TEST(Bodies, HaveCurvesOfDistanceAndAngle)
{
    auto a = first(), b = second();
    const auto session = common_session(a.content(), b.content());
    ASSERT_TRUE(session);
    const SessionCurves curves = curves_of(*session);
    ASSERT_EQ(curves.bodies.size(), 2U);
    EXPECT_EQ(curves.bodies[1].name, "body 3");
    ASSERT_EQ(curves.bodies[1].apart_mm.size(), 5000U);
    EXPECT_NEAR(curves.bodies[1].apart_mm[100].value, 10.0, 1e-9);
    EXPECT_NEAR(curves.bodies[1].turned_apart_deg[4000].value, 2.0, 1e-9);
}

TEST(Bodies, AreInTheTraceThatMetricsAreTakenOf)
{
    auto a = first(), b = second();
    const auto session = common_session(a.content(), b.content());
    ASSERT_TRUE(session);
    const virtual_time::Trace trace = trace_of(*session);
    EXPECT_EQ(trace.further_bodies, 1U);
    ASSERT_EQ(trace.further.size(), 2U);
    ASSERT_EQ(trace.further[1].size(), trace.sides[1].size());
    EXPECT_EQ(trace.further[1][1000].position.z(), 0.010);
    EXPECT_EQ(trace.further[0][1000].position.z(), 0.0);
    EXPECT_EQ(trace.further[1][1000].orientation, turned(20.0 * degree));
    ASSERT_EQ(trace.settled.size(), 2U);
    EXPECT_EQ(trace.settled[0].metres, 0.0);
    EXPECT_NEAR(trace.settled[1].metres, 0.001, 1e-15);
    EXPECT_NEAR(trace.settled[1].radians, 2.0 * degree, 1e-12);
}

TEST(Bodies, AreInTheTraceOfMoreThanTwoOnceForEachOfThem)
{
    auto a = first(), b = second(), c = with_two_bodies(3, -0.005, 0.0);
    // B with each of the others. The sides are still in the order of their ids.
    const std::vector<Session> sessions{*common_session(b.content(), c.content()),
                                        *common_session(b.content(), a.content())};
    const virtual_time::Trace trace = trace_of(sessions);
    ASSERT_EQ(trace.sides.size(), 3U);
    ASSERT_EQ(trace.further.size(), 3U);
    EXPECT_EQ(trace.further[0][1000].position.z(), 0.0);
    EXPECT_EQ(trace.further[1][1000].position.z(), 0.010);
    EXPECT_EQ(trace.further[2][1000].position.z(), -0.005);
    ASSERT_EQ(trace.settled.size(), 2U);
    EXPECT_NEAR(trace.settled[1].metres, 0.0015, 1e-15) << "of the farthest two";
}

TEST(Bodies, AreLinesOfACsvAlsoWhereOnlyTheTickHoldsOne)
{
    EXPECT_EQ(body_csv_header(),
              "time_s,tick,body,position_x_mm,position_y_mm,position_z_mm,velocity_x_mm_per_s,"
              "velocity_y_mm_per_s,velocity_z_mm_per_s,orientation_w,orientation_x,orientation_y,"
              "orientation_z,angular_velocity_x_rad_per_s,angular_velocity_y_rad_per_s,"
              "angular_velocity_z_rad_per_s,owner");
    std::vector<std::string> lines;
    const auto take = [&](const std::string& line) { lines.push_back(line); };
    for_each_body_csv_line(second().content(), start, take);
    ASSERT_EQ(lines.size(), 10000U);
    EXPECT_EQ(lines[1], "0.000000000,0,2,0.000000,0.000000,10.000000,0.000000,0.000000,0.000000,"
                        "0.984808,0.000000,0.173648,0.000000,0.000000,0.000000,0.000000,");
    lines.clear();
    for_each_body_csv_line(owned(1, 1).content(), start, take);
    EXPECT_TRUE(lines[0].ends_with(",0.000000,1")) << lines[0];
    lines.clear();
    Recording plain{1};
    plain.session(1s).ticks(1ms, 2ms, Phase::running, cube_at(0.25));
    for_each_body_csv_line(plain.content(), start, take);
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_TRUE(lines[0].starts_with("0.001000000,0,0,250.000000,")) << lines[0];
    EXPECT_TRUE(lines[0].ends_with(",")) << "no owner";
}

} // namespace
} // namespace hapnet::lab::records
