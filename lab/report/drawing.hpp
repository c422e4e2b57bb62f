// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/plot/bars.hpp"
#include "proto/plot/plot.hpp"

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace hapnet::lab::report {

/// A figure twice: still, for files and for pages without scripts, and as the data from which
/// web/page/report draws it.
struct Drawing {
    std::string svg;
    nlohmann::ordered_json data{};
};

/// Curves, with the titles and options of plot::svg_plot(). The data has every point, to seven
/// digits; the still drawing of a long curve is thinned to what its pixels show.
[[nodiscard]] Drawing drawn_plot(const plot::PlotTitles& titles,
                                 std::span<const plot::Curve> curves,
                                 const plot::PlotOptions& options = {});

/// Groups of bars, as plot::svg_bars().
[[nodiscard]] Drawing drawn_bars(const plot::PlotTitles& titles,
                                 const std::vector<plot::BarGroup>& groups,
                                 const std::vector<plot::LegendEntry>& legend, plot::Size size);

/// What data shows, as CSV: "curve,x,y" or "group,bar,value,low,high", in its units. Points without
/// a name in the legend have that of the curve before.
[[nodiscard]] std::string csv_of(const nlohmann::ordered_json& data);

/// JSON that can stand inside a script element: nothing in it closes that.
[[nodiscard]] std::string in_script(const nlohmann::ordered_json& json);

} // namespace hapnet::lab::report
