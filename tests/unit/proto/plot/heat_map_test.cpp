// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/plot/heat_map.hpp"
#include "tests/unit/proto/plot/holds.hpp"

#include <gtest/gtest.h>
#include <string>

namespace hapnet::plot {
namespace {

TEST(HeatMap, DrawsEachFieldWithColourSymbolAndWords)
{
    const HeatMap map{{"0", "160"}, {"0", "± 5"}, {{1, 1, "#123456", "×", "a < b"}}};
    // 150 by 100 for each field: the upper right one begins at 210, 34.
    const std::string svg = svg_heat_map({"t", "delay", "jitter"}, map, {375.0, 278.0});
    EXPECT_TRUE(holds(svg, "x='210.5' y='34.5' width='149.0' height='99.0' fill='#123456'")) << svg;
    EXPECT_TRUE(holds(svg, ">×</text>"));
    EXPECT_TRUE(holds(svg, "<title>a &lt; b</title>"));
}

} // namespace
} // namespace hapnet::plot
