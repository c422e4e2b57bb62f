// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/plot/axis.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::plot {

/// One field of a heat map. The symbol says the same as the colour, for those who see no colours.
struct HeatCell {
    std::size_t column = 0;
    std::size_t row = 0; // 0: lowest
    std::string_view colour;
    std::string_view symbol;
    std::string tip; // shown where a pointer rests
};

struct HeatMap {
    std::vector<std::string> columns; // what stands below each
    std::vector<std::string> rows;    // and beside each, from the lowest up
    std::vector<HeatCell> cells;
};

/// A heat map as one SVG element.
[[nodiscard]] std::string svg_heat_map(const PlotTitles& titles, const HeatMap& map, Size size);

} // namespace hapnet::plot
