// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/plot/heat_map.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::plot {

std::string svg_heat_map(const PlotTitles& titles, const HeatMap& map, Size size)
{
    const Margins margins = margins_for(size, false);
    const double floor = size.height - margins.bottom;
    const auto columns = static_cast<double>(std::max<std::size_t>(map.columns.size(), 1));
    const auto rows = static_cast<double>(std::max<std::size_t>(map.rows.size(), 1));
    const double width = (size.width - margins.left - margins.right) / columns;
    const double height = (floor - margins.top) / rows;
    std::string out = svg_head(size, titles, {});
    for (std::size_t i = 0; i < map.columns.size(); ++i) {
        out += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='middle'>{}</text>\n",
                           margins.left + (static_cast<double>(i) + 0.5) * width, floor + 16.0,
                           escaped(map.columns[i]));
    }
    for (std::size_t i = 0; i < map.rows.size(); ++i) {
        out += fmt::format(
            "<text x='{:.1f}' y='{:.1f}' text-anchor='end'>{}</text>\n", margins.left - 6.0,
            floor - (static_cast<double>(i) + 0.5) * height + 4.0, escaped(map.rows[i]));
    }
    for (const HeatCell& cell : map.cells) {
        const double left = margins.left + static_cast<double>(cell.column) * width;
        const double top = floor - static_cast<double>(cell.row + 1) * height;
        out += fmt::format("<g><title>{}</title><rect x='{:.1f}' y='{:.1f}' width='{:.1f}' "
                           "height='{:.1f}' fill='{}'/><text x='{:.1f}' y='{:.1f}' "
                           "text-anchor='middle' fill='#000'>{}</text></g>\n",
                           escaped(cell.tip), left + 0.5, top + 0.5, width - 1.0, height - 1.0,
                           cell.colour, left + width / 2.0, top + height / 2.0 + 4.0,
                           escaped(cell.symbol));
    }
    return out + "</svg>\n";
}

} // namespace hapnet::plot
