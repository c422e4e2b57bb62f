// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/page/figure.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::page {
namespace {

Figure curves_figure(std::vector<Curve> curves)
{
    return {.id = "a",
            .title = "A title",
            .x = {"time", "s"},
            .y = {"error", "mm", Scale::logarithmic, {0.1, 1.0}},
            .content = Curves{std::move(curves), {{0.5, "limit"}}}};
}

TEST(Figure, OfCurvesHasAxesSeriesAndLevels)
{
    const Json json = json_of(curves_figure({{.name = "base",
                                              .colour = "base",
                                              .points = {{0.0, 1.0}, {1.0, 2.0}},
                                              .scatter = {{0.5, 3.0}}}}));
    EXPECT_EQ(json["id"], "a");
    EXPECT_EQ(json["kind"], "curves");
    EXPECT_EQ(json["x"].dump(), R"({"label":"time","unit":"s"})");
    EXPECT_EQ(json["y"].dump(), R"({"label":"error","unit":"mm","scale":"log","range":[0.1,1.0]})");
    EXPECT_EQ(json["series"][0]["points"].dump(), "[[0.0,1.0],[1.0,2.0]]");
    EXPECT_EQ(json["levels"].dump(), R"([{"y":0.5,"name":"limit"}])");
    EXPECT_EQ(csv_of(json),
              "curve,time_s,error_mm\n\"base\",0.0,1.0\n\"base\",1.0,2.0\n\"base\",0.5,3.0\n");
}

TEST(Figure, LeavesOutWhatIsNotFiniteAndKeepsSevenDigits)
{
    const Json json = json_of(curves_figure(
        {{.name = "a", .colour = "base", .points = {{0.0, std::nan("")}, {1.0, 1.23456789}}}}));
    EXPECT_EQ(json["series"][0]["points"].dump(), "[[1.0,1.234568]]");
}

Bar bar(std::string series, double value, std::string_view colour)
{
    return {.series = std::move(series), .value = value, .text = "t", .colour = colour, .tip = "i"};
}

TEST(Figure, OfBarsHasTheSeriesInTheOrderOfTheGroups)
{
    const Json json =
        json_of({.id = "b",
                 .title = "B",
                 .x = {"group"},
                 .y = {"limit", "ms"},
                 .content = Bars{{"one", {bar("run", 1.0, "base")}},
                                 {"two", {bar("paper", 2.0, "sep"), bar("run", 3.0, "sep")}}}});
    EXPECT_EQ(json["x"]["categories"].dump(), R"(["one","two"])");
    ASSERT_EQ(json["series"].size(), 2U);
    EXPECT_EQ(json["series"][0]["name"], "paper") << "it stands before the run where it is";
    EXPECT_EQ(json["series"][0]["colour"], "sep");
    EXPECT_FALSE(json["series"][1].contains("colour")) << "its bars have two";
    EXPECT_EQ(json["series"][1]["bars"][1]["colour"], "sep");
    EXPECT_EQ(csv_of(json),
              "group,bar,value_ms,low_ms,high_ms\n\"one\",\"i\",1.0,,\n\"two\",\"i\",2.0,,\n"
              "\"two\",\"i\",3.0,,\n");
}

TEST(Figure, OfBarsSaysWhatIsOpenMissedAndUncertain)
{
    Bar one = bar("run", 5.0, "base");
    one.is_open = one.is_missed = true;
    one.interval = Range{4.0, 6.0};
    const Json json = json_of(
        {.id = "b", .title = "B", .x = {}, .y = {}, .content = Bars{{"g", {std::move(one)}}}});
    EXPECT_EQ(json["series"][0]["bars"][0].dump(),
              R"({"at":0,"value":5.0,"text":"t","open":true,"missed":true,"low":4.0,"high":6.0,)"
              R"("tip":"i"})");
}

TEST(Figure, OfAHeatMapHasFieldsByColumnAndRow)
{
    const Json json = json_of(
        {.id = "h",
         .title = "H",
         .x = {"delay", "ms"},
         .y = {"jitter", "ms"},
         .content = HeatMap{{"0", "160"}, {"0", "5"}, {{1, 0, "good", 0.5, "×", "a < b"}}}});
    EXPECT_EQ(json["series"][0]["cells"].dump(),
              R"([{"x":1,"y":0,"colour":"good","opacity":0.5,"symbol":"×","tip":"a < b"}])");
}

TEST(Thinned, KeepsThePeaks)
{
    std::vector<Point> points;
    for (int i = 0; i < 1000; ++i) points.push_back({1.0 * i, i == 617 ? 9.0 : 0.0});
    const auto few = thinned(points, 100);
    EXPECT_LE(few.size(), 100U);
    EXPECT_TRUE(std::any_of(few.begin(), few.end(), [](const Point& p) { return p.y == 9.0; }));
    EXPECT_EQ(thinned(few, 100).size(), few.size());
}

TEST(PlainId, HasNothingThatAPathOrAnAddressWouldTakeApart)
{
    EXPECT_EQ(plain_id("fig7-<b>/.."), "fig7--b----");
}

} // namespace
} // namespace hapnet::page
