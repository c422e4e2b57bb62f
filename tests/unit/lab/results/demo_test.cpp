// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/demo.hpp"

#include <gtest/gtest.h>

namespace hapnet::lab::results {
namespace {

using Json = nlohmann::ordered_json;

Json direction()
{
    return {{"received", 100}, {"duplicated", 1},
            {"delivered", 90}, {"dropped", {{"random_loss", 6}, {"queue_full", 3}}},
            {"in_flight", 2},  {"lateness_us", {{"p99", 50.0}}}};
}

Json way() { return {{"delay_ms", {{"p50", 160.02}}}, {"packets_per_s", 999.8}}; }

SessionFiles task(double mean_mm)
{
    return {{{"discrepancy_x_mm", {{"mean", mean_mm}, {"min", 0.0}, {"max", 44.0}, {"std", 10.5}}},
             {"force_discrepancy_n", nullptr},
             {"a_to_b", way()},
             {"b_to_a", way()},
             {"valid", true},
             {"invalid_because", Json::array()}},
            {{"seed", 42}, {"up", direction()}, {"down", direction()}, {"valid", true}},
            {{"seed", 1}, {"task", "P1"}, {"duration_s", 30.0}}};
}

DemoRun run(double mean_mm) { return {task(mean_mm), task(5.0)}; }

TEST(DemoReport, IsMetWithin15PercentOfThePapersMeanAndNotBeyond)
{
    EXPECT_TRUE(demo_is_met(run(13.79)));
    EXPECT_TRUE(demo_is_met(run(11.73)));
    EXPECT_FALSE(demo_is_met(run(11.71)));
    EXPECT_TRUE(demo_is_met(run(15.85)));
    EXPECT_FALSE(demo_is_met(run(15.87)));
}

TEST(DemoReport, IsNotMetWhenTheEmulatorLostCount)
{
    for (const char* count : {"received", "duplicated", "delivered", "in_flight"}) {
        DemoRun miscounted = run(13.79);
        miscounted.t3.emulator["down"][count] = 1000;
        EXPECT_FALSE(demo_is_met(miscounted)) << count;
        EXPECT_NE(demo_table(miscounted).find("NOT ALL"), std::string::npos) << count;
    }
}

TEST(DemoReport, PutsTheMeasurementBesideThePaper)
{
    const auto table = demo_table(run(13.345));
    EXPECT_NE(table.find("paper                           13.79     0.00    46.01    10.99"),
              std::string::npos)
        << table;
    EXPECT_NE(table.find("this run                        13.35     0.00    44.00    10.50"),
              std::string::npos)
        << table;
    EXPECT_NE(table.find("15 % of the paper's: met"), std::string::npos);
    EXPECT_NE(table.find("1000 +- 5: met"), std::string::npos);
    EXPECT_NE(table.find("The run is valid"), std::string::npos);
}

TEST(DemoReport, SaysWhatWasMissed)
{
    DemoRun late = run(20.0);
    late.p1.analysis["a_to_b"]["delay_ms"]["p50"] = 161.5;
    const auto table = demo_table(late);
    EXPECT_NE(table.find("15 % of the paper's: MISSED"), std::string::npos);
    EXPECT_NE(table.find("160 +- 1: MISSED"), std::string::npos);
}

TEST(DemoReport, IsNotMetWhenOneRowOfOneTaskIsMissed)
{
    for (const char* way : {"a_to_b", "b_to_a"}) {
        DemoRun late = run(13.79);
        late.t3.analysis[way]["delay_ms"]["p50"] = 161.01;
        EXPECT_FALSE(demo_is_met(late)) << way;
        DemoRun slow = run(13.79);
        slow.p1.analysis[way]["packets_per_s"] = 994.9;
        EXPECT_FALSE(demo_is_met(slow)) << way;
    }
}

TEST(DemoReport, AnInvalidTaskMakesTheWholeInvalidAndSaysWhy)
{
    DemoRun invalid = run(13.79);
    invalid.t3.analysis["invalid_because"] = {"b missed 2 % of its ticks"};
    invalid.p1.emulator["valid"] = false;
    const auto table = demo_table(invalid);
    EXPECT_NE(table.find("NOT VALID"), std::string::npos);
    EXPECT_FALSE(demo_is_valid(invalid));
    EXPECT_TRUE(demo_is_valid(run(13.79)));
    EXPECT_NE(table.find("T3: b missed 2 % of its ticks"), std::string::npos);
    const Json manifest = demo_manifest(invalid, {});
    EXPECT_EQ(manifest["kind"], "demo");
    EXPECT_EQ(manifest["valid"], false);
    EXPECT_EQ(manifest["invalid_because"].size(), 2U);
}

TEST(DemoReport, TheManifestTellsHowToRepeatTheRun)
{
    const Json manifest = demo_manifest(
        run(13.79), {"scripts/demo.sh", "2026-01-02T03:04:05Z", 53.0, {{"name", "box"}}});
    EXPECT_EQ(manifest["command"], "scripts/demo.sh");
    EXPECT_EQ(manifest["start"], "2026-01-02T03:04:05Z");
    EXPECT_EQ(manifest["wall_time_s"], 53.0);
    EXPECT_EQ(manifest["host"]["name"], "box");
    EXPECT_EQ(manifest["seeds"], (Json{{"peers", 1}, {"emulator", 42}}));
    EXPECT_EQ(manifest["configuration"]["p1"]["duration_s"], 30.0);
    EXPECT_EQ(manifest["valid"], true);
    for (const char* key : {"version", "commit", "compiler"}) {
        EXPECT_FALSE(manifest[key].get<std::string>().empty()) << key;
    }
}

TEST(DemoReport, MissingNumbersAreDashesAndNoSuccess)
{
    DemoRun empty;
    empty.p1 = {Json::object(), Json::object(), Json::object()};
    empty.t3 = empty.p1;
    EXPECT_FALSE(demo_is_met(empty));
    EXPECT_NE(demo_table(empty).find(" -"), std::string::npos);
}

TEST(DemoReport, OfManyHandsSaysWhoPlayedAndWhetherItCounts)
{
    CircleDemo demo{"t7", task(2.0)};
    demo.files.peer["task"] = "T7";
    demo.files.peer["peer_id"] = 1;
    demo.files.peer["others"] = Json::array({Json{{"id", 2}}, Json{{"id", 3}}});
    Json manifest = circle_demo_manifest(demo, {.command = "demo", .start = "now"});
    EXPECT_EQ(manifest["kind"], "demo");
    EXPECT_EQ(manifest["title"], "3 peers, one cube, task T7");
    EXPECT_EQ(manifest["configuration"]["t7"]["task"], "T7");
    EXPECT_EQ(manifest["seeds"]["emulator"], 42);
    EXPECT_EQ(manifest["valid"], true);
    demo.files.emulator["valid"] = false;
    manifest = circle_demo_manifest(demo, {.command = "demo", .start = "now"});
    EXPECT_EQ(manifest["valid"], false);
    EXPECT_EQ(manifest["invalid_because"].size(), 1U);
    EXPECT_NE(circle_demo_verdict(demo).find("NOT VALID"), std::string::npos);
    EXPECT_FALSE(circle_demo_is_valid(demo));
}

} // namespace
} // namespace hapnet::lab::results
