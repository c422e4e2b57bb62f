// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/drawing.hpp"

#include <cmath>

namespace hapnet::lab::report {

namespace {

using Data = nlohmann::ordered_json;

Data titled(std::string_view kind, const plot::PlotTitles& titles, plot::Size size)
{
    return {{"kind", kind},  {"title", titles.title}, {"x", titles.x},
            {"y", titles.y}, {"width", size.width},   {"height", size.height}};
}

Data ends_of(const plot::Range& range)
{
    if (range.is_empty()) return Data::array();
    return {range.low, range.high};
}

std::string_view dashes_of(plot::Stroke stroke)
{
    switch (stroke) {
    case plot::Stroke::solid: break;
    case plot::Stroke::dashed: return "6 3";
    case plot::Stroke::dotted: return "2 2";
    }
    return "none";
}

Data data_of(const plot::Curve& curve)
{
    Data points = Data::array();
    for (const plot::Point& point : curve.points) {
        if (std::isfinite(point.x) && std::isfinite(point.y))
            points.push_back(Data::array({point.x, point.y}));
    }
    return {{"name", curve.name},
            {"colour", curve.colour},
            {"width", curve.width},
            {"dots", curve.shows_points},
            {"dashes", dashes_of(curve.stroke)},
            {"points", std::move(points)}};
}

Data data_of(const plot::Bar& bar)
{
    Data data{{"value", bar.value},   {"label", bar.label},
              {"colour", bar.colour}, {"outlined", bar.is_outlined},
              {"open", bar.is_open},  {"missed", bar.is_missed},
              {"tip", bar.tip}};
    if (bar.interval) {
        data["low"] = bar.interval->low;
        data["high"] = bar.interval->high;
    }
    return data;
}

} // namespace

Drawing drawn_plot(const plot::PlotTitles& titles, std::span<const plot::Curve> curves,
                   const plot::PlotOptions& options)
{
    Data data = titled("plot", titles, options.size);
    data["log_x"] = options.scales.x == plot::Scale::logarithmic;
    data["log_y"] = options.scales.y == plot::Scale::logarithmic;
    data["range_x"] = ends_of(options.x);
    data["range_y"] = ends_of(options.y);
    data["levels"] = Data::array();
    for (const plot::Level& level : options.levels)
        data["levels"].push_back({{"y", level.y}, {"name", level.name}});
    data["curves"] = Data::array();
    for (const plot::Curve& curve : curves) data["curves"].push_back(data_of(curve));
    return {plot::svg_plot(titles, curves, options), std::move(data)};
}

Drawing drawn_bars(const plot::PlotTitles& titles, const std::vector<plot::BarGroup>& groups,
                   const std::vector<plot::LegendEntry>& legend, plot::Size size)
{
    Data data = titled("bars", titles, size);
    data["legend"] = Data::array();
    for (const plot::LegendEntry& entry : legend)
        data["legend"].push_back({{"name", entry.name}, {"colour", entry.colour}});
    data["groups"] = Data::array();
    for (const plot::BarGroup& group : groups) {
        Data bars = Data::array();
        for (const plot::Bar& bar : group.bars) {
            if (std::isfinite(bar.value)) bars.push_back(data_of(bar));
        }
        data["groups"].push_back({{"name", group.name}, {"bars", std::move(bars)}});
    }
    return {plot::svg_bars(titles, groups, legend, size), std::move(data)};
}

std::string in_script(const nlohmann::ordered_json& json)
{
    std::string out;
    for (const char c : json.dump(-1, ' ', true, Data::error_handler_t::replace)) {
        if (c == '<') {
            out += "\\u003c";
        } else {
            out += c;
        }
    }
    return out;
}

} // namespace hapnet::lab::report
