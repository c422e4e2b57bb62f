// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/plot/bars.hpp"
#include "tests/unit/proto/plot/holds.hpp"

#include <gtest/gtest.h>
#include <string>
#include <utility>

namespace hapnet::plot {
namespace {

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

} // namespace
} // namespace hapnet::plot
