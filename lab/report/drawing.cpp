// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/drawing.hpp"

#include <cmath>
#include <spdlog/fmt/fmt.h>
#include <vector>

namespace hapnet::lab::report {

namespace {

using Data = nlohmann::ordered_json;

constexpr std::size_t still_points_max = 1000; // of a curve: two for each pixel, about

/// To seven digits: more than a record has, and half as long as a double.
double short_value(double value)
{
    if (value == 0.0) return 0.0;
    const double digits = 6.0 - std::floor(std::log10(std::abs(value)));
    if (std::abs(digits) > 22.0) return value; // beyond it powers of ten are not exact
    const double scale = std::pow(10.0, std::abs(digits));
    return digits >= 0.0 ? std::round(value * scale) / scale : std::round(value / scale) * scale;
}

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
            points.push_back(Data::array({short_value(point.x), short_value(point.y)}));
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
    std::vector<plot::Curve> still{curves.begin(), curves.end()};
    for (plot::Curve& curve : still) {
        data["curves"].push_back(data_of(curve));
        curve.points = plot::thinned(curve.points, still_points_max);
    }
    return {plot::svg_plot(titles, still, options), std::move(data)};
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

std::string csv_of(const nlohmann::ordered_json& data)
{
    const auto quoted = [](const Data& text) {
        std::string out = "\"";
        for (const char c : text.get<std::string>()) out += c == '"' ? "\"\"" : std::string{c};
        return out + '"';
    };
    if (data.at("kind").get<std::string>() == "bars") {
        std::string out = "group,bar,value,low,high\n";
        for (const Data& group : data.at("groups")) {
            for (const Data& bar : group.at("bars")) {
                const auto end = [&](const char* name) {
                    return bar.contains(name) ? bar.at(name).dump() : std::string{};
                };
                out +=
                    fmt::format("{},{},{},{},{}\n", quoted(group.at("name")), quoted(bar.at("tip")),
                                bar.at("value").dump(), end("low"), end("high"));
            }
        }
        return out;
    }
    std::string out = "curve,x,y\n", name = "\"\"";
    for (const Data& curve : data.at("curves")) {
        if (!curve.at("name").get<std::string>().empty()) name = quoted(curve.at("name"));
        for (const Data& point : curve.at("points"))
            out += fmt::format("{},{},{}\n", name, point.at(0).dump(), point.at(1).dump());
    }
    return out;
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
