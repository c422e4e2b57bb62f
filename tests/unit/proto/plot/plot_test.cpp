// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/plot/plot.hpp"
#include "tests/unit/proto/plot/holds.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <limits>

namespace hapnet::plot {
namespace {

std::string plot_of(const std::vector<Point>& points)
{
    const std::array curves{Curve{.name = "peer 1", .colour = "#123456", .points = points}};
    return svg_plot({"a title", "s", "mm"}, curves);
}

TEST(Plot, SpreadsACurveOverTheWholeFrame)
{
    const std::string svg = plot_of({{0.0, -1.0}, {10.0, 1.0}});
    EXPECT_NE(svg.find("points='60.0,236.0 885.0,34.0 '"), std::string::npos) << svg;
    EXPECT_NE(svg.find("a title"), std::string::npos);
    EXPECT_NE(svg.find(">peer 1</text>"), std::string::npos);
}

TEST(Plot, MarksRoundNumbers)
{
    const std::string svg = plot_of({{0.0, -70.0}, {30.0, 75.0}});
    for (const char* mark : {">-50</text>", ">0</text>", ">50</text>", ">25</text>"}) {
        EXPECT_NE(svg.find(mark), std::string::npos) << mark;
    }
}

TEST(Plot, LeavesOutWhatIsNotFinite)
{
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const std::string svg = plot_of({{0.0, -1.0}, {5.0, nan}, {infinity, 0.0}, {10.0, 1.0}});
    EXPECT_EQ(svg, plot_of({{0.0, -1.0}, {10.0, 1.0}}));
}

TEST(Plot, OfNothingOrOfOneValueIsStillAPlot)
{
    for (const auto& points : {std::vector<Point>{}, std::vector<Point>{{1.0, 2.0}}}) {
        const std::string svg = plot_of(points);
        EXPECT_EQ(svg.find("nan"), std::string::npos);
        EXPECT_EQ(svg.find("inf"), std::string::npos);
        EXPECT_TRUE(svg.ends_with("</svg>\n"));
    }
}

TEST(Plot, DividesALogarithmicAxisIntoWholeDecadesAndLeavesOutWhatHasNoLogarithm)
{
    const std::vector<Point> points{{10.0, 1e-15}, {100.0, 0.0}, {1000.0, 1e-3}, {-1.0, 1.0}};
    const std::array curves{Curve{.name = "peer 1", .colour = "#123456", .points = points}};
    const std::string svg =
        svg_plot({"t", "x", "y"}, curves, {.scales = {Scale::logarithmic, Scale::logarithmic}});
    EXPECT_NE(svg.find("points='60.0,236.0 885.0,34.0 '"), std::string::npos) << svg;
    for (const char* mark : {">10</text>", ">1000</text>", ">1e-14</text>", ">1e-4</text>"}) {
        EXPECT_NE(svg.find(mark), std::string::npos) << mark;
    }
}

TEST(Plot, ShowsTheLevelThatACurveIsHeldAgainstAndWhereItFails)
{
    const std::array curves{
        Curve{.name = "a", .colour = "#123456", .points = {{0.0, 0.0}, {10.0, 1.0}}}};
    const std::string svg = svg_plot(
        {"t", "x", "y"}, curves, {.levels = {{2.0, "usable"}}, .crosses = {{{5.0, 1.0}, "#9"}}});
    EXPECT_TRUE(holds(svg, ">usable</text>"));
    EXPECT_TRUE(holds(svg, "885.0,135.0 ")) << "the level, at 2, is the top: " << svg;
    EXPECT_TRUE(holds(svg, "<path d='M472.5 135.0m-6-6l12 12m0-12l-12 12' stroke='#9'"));
}

TEST(Plot, EscapesTitlesAndNames)
{
    const std::array curves{Curve{.name = "<b>", .colour = "#123456"}};
    const std::string svg = svg_plot({"a & b", "'", "\""}, curves);
    EXPECT_TRUE(holds(svg, ">&lt;b&gt;</text>"));
    EXPECT_TRUE(holds(svg, "aria-label='a &amp; b'"));
}

TEST(Thinned, KeepsEveryPeakAndTheOrder)
{
    std::vector<Point> points;
    for (int i = 0; i < 10'000; ++i) points.push_back({static_cast<double>(i), 0.0});
    points[5001].y = 7.0;
    points[5002].y = -7.0;
    const auto kept = thinned(points, 100);
    EXPECT_LE(kept.size(), 102U);
    double low = 0.0, high = 0.0;
    for (std::size_t i = 0; i < kept.size(); ++i) {
        low = std::min(low, kept[i].y);
        high = std::max(high, kept[i].y);
        EXPECT_TRUE(i == 0 || kept[i - 1].x < kept[i].x);
    }
    EXPECT_EQ(low, -7.0);
    EXPECT_EQ(high, 7.0);
    EXPECT_EQ(thinned(points, 10'000).size(), 10'000U);
}

} // namespace
} // namespace hapnet::plot
