// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/page/figure.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::page {

namespace {

/// Rounds to seven digits. A record has fewer, and the text is half as long as with all digits of a
/// double.
double short_value(double value)
{
    if (value == 0.0) return 0.0;
    const double digits = 6.0 - std::floor(std::log10(std::abs(value)));
    if (std::abs(digits) > 22.0) return value; // beyond 22, powers of ten are not exact
    const double scale = std::pow(10.0, std::abs(digits));
    return digits >= 0.0 ? std::round(value * scale) / scale : std::round(value / scale) * scale;
}

Json json_of(const Axis& axis)
{
    Json json{{"label", axis.label}, {"unit", axis.unit}};
    if (axis.scale == Scale::logarithmic) json["scale"] = "log";
    if (!axis.range.is_empty()) json["range"] = Json::array({axis.range.low, axis.range.high});
    return json;
}

/// Returns an axis of categories: groups, columns or rows.
Json json_of(const Axis& axis, const std::vector<std::string>& categories)
{
    Json json = json_of(axis);
    json["categories"] = categories;
    return json;
}

Json json_of(const std::vector<Point>& points)
{
    Json list = Json::array();
    for (const Point& point : points) {
        if (std::isfinite(point.x) && std::isfinite(point.y))
            list.push_back(Json::array({short_value(point.x), short_value(point.y)}));
    }
    return list;
}

Json json_of(const Curve& curve)
{
    Json json{{"name", curve.name}, {"colour", curve.colour}, {"width", curve.width}};
    if (curve.is_dashed) json["dash"] = "6 3";
    if (curve.shows_points) json["dots"] = true;
    json["points"] = json_of(curve.points);
    if (!curve.scatter.empty()) json["scatter"] = json_of(curve.scatter);
    for (const BandPoint& one : curve.band) {
        json["band"].push_back(
            Json::array({short_value(one.x), short_value(one.y.low), short_value(one.y.high)}));
    }
    if (curve.crossing) {
        const auto& [y, x] = *curve.crossing;
        json["crossing"] = {{"y", y}, {"low", short_value(x.low)}, {"high", short_value(x.high)}};
    }
    return json;
}

Json json_of(const Bar& bar, std::size_t at)
{
    Json json{{"at", at}, {"value", bar.value}, {"text", bar.text}};
    if (bar.is_open) json["open"] = true;
    if (bar.is_missed) json["missed"] = true;
    if (bar.interval) {
        json["low"] = bar.interval->low;
        json["high"] = bar.interval->high;
    }
    json["tip"] = bar.tip;
    return json;
}

/// Returns the names of the series in the order of the groups. A group may lack some of them.
std::vector<std::string> series_in(const Bars& groups)
{
    std::vector<std::string> names;
    for (const BarGroup& group : groups) {
        auto place = names.begin();
        for (const Bar& bar : group.bars) {
            const auto known = std::find(names.begin(), names.end(), bar.series);
            place = (known != names.end() ? known : names.insert(place, bar.series)) + 1;
        }
    }
    return names;
}

/// A series has a colour if all of its bars have the same one.
Json series_of(const Bars& groups, const std::string& name)
{
    Json bars = Json::array();
    std::vector<const Bar*> all;
    for (std::size_t at = 0; at < groups.size(); ++at) {
        for (const Bar& bar : groups[at].bars) {
            if (bar.series != name || !std::isfinite(bar.value)) continue;
            all.push_back(&bar);
            bars.push_back(json_of(bar, at));
        }
    }
    Json series = Json::object();
    series["name"] = name;
    if (all.empty()) return series;
    const bool is_one_colour = std::all_of(
        all.begin(), all.end(), [&](const Bar* bar) { return bar->colour == all[0]->colour; });
    if (is_one_colour) series["colour"] = all[0]->colour;
    for (std::size_t i = 0; i < all.size() && !is_one_colour; ++i)
        bars[i]["colour"] = all[i]->colour;
    if (all[0]->is_outlined) series["outlined"] = true;
    series["bars"] = std::move(bars);
    return series;
}

void add_content(Json& json, const Figure& figure, const Curves& content)
{
    json["kind"] = "curves";
    json["x"] = json_of(figure.x);
    json["y"] = json_of(figure.y);
    json["series"] = Json::array();
    for (const Curve& curve : content.curves) json["series"].push_back(json_of(curve));
    for (const Level& level : content.levels)
        json["levels"].push_back({{"y", level.y}, {"name", level.name}});
    for (const double moment : content.moments) json["moments"].push_back(short_value(moment));
}

void add_content(Json& json, const Figure& figure, const Bars& groups)
{
    json["kind"] = "bars";
    std::vector<std::string> categories;
    for (const BarGroup& group : groups) categories.push_back(group.name);
    json["x"] = json_of(figure.x, categories);
    json["y"] = json_of(figure.y);
    json["series"] = Json::array();
    for (const std::string& name : series_in(groups)) {
        if (Json series = series_of(groups, name); series.contains("bars"))
            json["series"].push_back(std::move(series));
    }
}

Json json_of(const DotRow& row, std::size_t at)
{
    Json json{{"at", at}, {"colour", row.colour}};
    const auto add = [&](const char* key, double value) {
        if (std::isfinite(value)) json[key] = short_value(value);
    };
    if (row.value) add("value", *row.value);
    if (row.interval) {
        add("low", row.interval->low);
        add("high", row.interval->high);
    }
    if (row.accepted) {
        json["accepted"] = true;
        add("from", row.accepted->low);
        add("to", row.accepted->high);
    }
    for (const double value : row.single) json["single"].push_back(short_value(value));
    if (row.is_missed) json["missed"] = true;
    json["tip"] = row.tip;
    return json;
}

void add_content(Json& json, const Figure& figure, const Dots& rows)
{
    json["kind"] = "dots";
    std::vector<std::string> names;
    Json dots = Json::array();
    for (const DotRow& row : rows) {
        dots.push_back(json_of(row, names.size()));
        names.push_back(row.name);
    }
    json["x"] = json_of(figure.x);
    json["y"] = json_of(figure.y, names);
    json["series"] = Json::array({{{"name", figure.title}, {"dots", std::move(dots)}}});
}

void add_content(Json& json, const Figure& figure, const HeatMap& map)
{
    json["kind"] = "heat-map";
    json["x"] = json_of(figure.x, map.columns);
    json["y"] = json_of(figure.y, map.rows);
    Json cells = Json::array();
    for (const HeatCell& one : map.cells) {
        Json cell{{"x", one.column}, {"y", one.row}, {"colour", one.colour}};
        if (one.opacity != 1.0) cell["opacity"] = one.opacity;
        if (!one.symbol.empty()) cell["symbol"] = one.symbol;
        cell["tip"] = one.tip;
        cells.push_back(std::move(cell));
    }
    Json series = Json::object();
    series["name"] = figure.title;
    series["cells"] = std::move(cells);
    json["series"] = Json::array();
    json["series"].push_back(std::move(series));
}

std::string quoted(const Json& text)
{
    std::string out = "\"";
    for (const char c : text.get<std::string>()) out += c == '"' ? "\"\"" : std::string{c};
    return out + '"';
}

/// Returns the letters and digits of the text, with one "_" between words. Characters outside ASCII
/// are left out.
std::string key_of(std::string_view text)
{
    std::string key;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 128 && std::isalnum(byte) != 0) {
            key += static_cast<char>(std::tolower(byte));
        } else if (byte < 128 && !key.empty() && key.back() != '_') {
            key += '_';
        }
    }
    while (key.ends_with('_')) key.pop_back();
    return key;
}

/// Returns the suffix of a column name for the axis's unit, such as "_ms"; "" without a unit.
std::string unit_key_of(const Json& axis)
{
    const auto unit = axis.value("unit", std::string{});
    if (unit.empty() || unit == "1") return "";
    constexpr std::array<std::pair<std::string_view, std::string_view>, 4> in_words{
        {{"%", "_percent"}, {"µs", "_us"}, {"1/ms", "_per_ms"}, {"Mbit/s", "_mbit_per_s"}}};
    const auto* const found =
        std::ranges::find(in_words, unit, [](const auto& one) { return one.first; });
    return found == in_words.end() ? "_" + key_of(unit) : std::string{found->second};
}

std::string head_of(const Json& axis, std::string_view otherwise)
{
    const std::string key = key_of(axis.value("label", std::string{}));
    return (key.empty() ? std::string{otherwise} : key) + unit_key_of(axis);
}

/// Returns column names such as "value_mm,low_mm,high_mm".
std::string value_heads(const Json& axis)
{
    return fmt::format("value{0},low{0},high{0}", unit_key_of(axis));
}

std::string csv_of_bars(const Json& figure)
{
    std::string out = fmt::format("group,bar,{}\n", value_heads(figure.at("y")));
    const Json& groups = figure.at("x").at("categories");
    for (std::size_t at = 0; at < groups.size(); ++at) {
        for (const Json& series : figure.at("series")) {
            for (const Json& bar : series.at("bars")) {
                if (bar.at("at").get<std::size_t>() != at) continue;
                const auto end = [&](const char* name) {
                    return bar.contains(name) ? bar.at(name).dump() : std::string{};
                };
                out += fmt::format("{},{},{},{},{}\n", quoted(groups[at]), quoted(bar.at("tip")),
                                   bar.at("value").dump(), end("low"), end("high"));
            }
        }
    }
    return out;
}

std::string csv_of_dots(const Json& figure)
{
    std::string out = fmt::format("row,{}\n", value_heads(figure.at("x")));
    const Json& names = figure.at("y").at("categories");
    for (const Json& series : figure.at("series")) {
        for (const Json& row : series.at("dots")) {
            const auto number = [&](const char* key) {
                return row.contains(key) ? row.at(key).dump() : std::string{};
            };
            out += fmt::format("{},{},{},{}\n", quoted(names.at(row.at("at").get<std::size_t>())),
                               number("value"), number("low"), number("high"));
        }
    }
    return out;
}

} // namespace

void Range::include(double value)
{
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
}

std::string plain_id(std::string text)
{
    for (char& c : text) {
        const bool is_plain =
            (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
        if (!is_plain) c = '-';
    }
    return text;
}

std::vector<Point> thinned(std::span<const Point> points, std::size_t count_max)
{
    if (points.size() <= count_max) return {points.begin(), points.end()};
    const std::size_t stretches = std::max<std::size_t>(count_max / 2, 1);
    const std::size_t length = (points.size() + stretches - 1) / stretches;
    std::vector<Point> kept;
    for (std::size_t begin = 0; begin < points.size(); begin += length) {
        const auto part = points.subspan(begin, std::min(length, points.size() - begin));
        const auto [low, high] = std::minmax_element(
            part.begin(), part.end(), [](const Point& a, const Point& b) { return a.y < b.y; });
        kept.push_back(*std::min(low, high));
        if (low != high) kept.push_back(*std::max(low, high));
    }
    return kept;
}

Json json_of(const Figure& figure)
{
    Json json{{"id", figure.id}, {"kind", ""}, {"title", figure.title}};
    std::visit([&](const auto& content) { add_content(json, figure, content); }, figure.content);
    json["width"] = figure.size.width;
    json["height"] = figure.size.height;
    json["caption"] = figure.caption;
    if (!figure.sources.empty()) json["sources"] = figure.sources;
    return json;
}

std::string csv_of(const Json& figure)
{
    const auto kind = figure.at("kind").get<std::string>();
    if (kind == "bars") return csv_of_bars(figure);
    if (kind == "dots") return csv_of_dots(figure);
    std::string out =
        fmt::format("curve,{},{}\n", head_of(figure.at("x"), "x"), head_of(figure.at("y"), "y"));
    for (const Json& series : figure.at("series")) {
        const std::string name = quoted(series.at("name"));
        for (const char* key : {"points", "scatter"}) {
            if (!series.contains(key)) continue;
            for (const Json& point : series.at(key))
                out += fmt::format("{},{},{}\n", name, point.at(0).dump(), point.at(1).dump());
        }
    }
    return out;
}

} // namespace hapnet::page
