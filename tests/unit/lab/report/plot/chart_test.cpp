// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/plot/bars.hpp"
#include "lab/report/plot/heat_map.hpp"
#include "lab/report/plot/plot.hpp"

#include <gtest/gtest.h>

namespace hapnet::lab::plot {
namespace {

bool holds(const std::string& text, std::string_view part)
{
    return text.find(part) != std::string::npos;
}

TEST(Bars, StandFromZeroToTheirValue)
{
    // 100 high between 34 and 134; the axis ends 12 % above the highest.
    const std::string svg =
        svg_bars({"t", "", "mm"}, {{"g", {{100.0, "100", "#123456"}}}}, {}, {675.0, 178.0});
    EXPECT_TRUE(holds(svg, "V44.7H381.6V134.0")) << svg;
    EXPECT_TRUE(holds(svg, ">100</text>"));
    EXPECT_TRUE(holds(svg, ">g</text>"));
}

TEST(Bars, AreDashedForOthersOpenForABoundAndRedForAMiss)
{
    const auto of = [](Bar bar) {
        return svg_bars({"t", "", "mm"}, {{"g", {std::move(bar)}}}, {}, {});
    };
    const std::string ours = of({5.0, "5", "#123456"});
    EXPECT_FALSE(holds(ours, "stroke-dasharray") || holds(ours, "--missed"));
    EXPECT_TRUE(holds(of({.value = 5.0, .label = "5", .colour = "#1", .is_outlined = true}),
                      "stroke-dasharray"));
    EXPECT_TRUE(holds(of({.value = 5.0, .label = "5", .colour = "#1", .is_missed = true}),
                      "fill='var(--missed)'"));
    const std::string open = of({.value = 5.0, .label = "> 5", .colour = "#1", .is_open = true});
    EXPECT_TRUE(holds(open, ">&gt; 5</text>"));
    EXPECT_FALSE(holds(open, "H")) << "no edge on top";
}

TEST(Bars, OfNothingAreStillAPlot)
{
    const std::string svg = svg_bars({"t", "", ""}, {}, {}, {});
    EXPECT_FALSE(holds(svg, "nan") || holds(svg, "inf"));
    EXPECT_TRUE(svg.ends_with("</svg>\n"));
}

TEST(HeatMap, DrawsEachFieldWithColourSymbolAndWords)
{
    const HeatMap map{{"0", "160"}, {"0", "± 5"}, {{1, 1, "#123456", "×", "a < b"}}};
    // 150 by 100 for each field: the upper right one begins at 210, 34.
    const std::string svg = svg_heat_map({"t", "delay", "jitter"}, map, {375.0, 278.0});
    EXPECT_TRUE(holds(svg, "x='210.5' y='34.5' width='149.0' height='99.0' fill='#123456'")) << svg;
    EXPECT_TRUE(holds(svg, ">×</text>"));
    EXPECT_TRUE(holds(svg, "<title>a &lt; b</title>"));
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
} // namespace hapnet::lab::plot
