// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/patterns.hpp"

#include "lab/metrics/paired.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::report {

namespace {

/// Names that programs use, and the words for people.
constexpr std::array<std::pair<std::string_view, std::string_view>, 9> names_for_people{
    {{"percent", "%"},
     {"of_100", "of 100"},
     {"random-loss", "random loss"},
     {"burst-loss", "burst loss"},
     {"interval", "interval between messages"},
     {"both.delay", "delay of the path"},
     {"jitter_order", "order of jittered messages"},
     {"algorithm.dead-reckoning.velocity", "velocity of dead reckoning"},
     {"algorithm.dead-reckoning.horizon", "horizon of dead reckoning"}}};

std::string cell_in_words(const TableRow& row, std::string_view key, std::string_view format)
{
    const auto number = row.number(key);
    if (format == "g") return number ? fmt::format("{:g}", *number) : "–";
    if (format == "limit") {
        constexpr double coarse = 20.0;
        return shown(number, number.value_or(0.0) < coarse ? 1 : 0);
    }
    if (!format.empty()) return shown(number, format.back() - '0');
    return people_say(row.text(key));
}

page::Bar bar_of(const BarPattern& pattern, const TableRow& row)
{
    page::Bar bar{.series = in_words(pattern.series, row),
                  .value = *row.number(pattern.value),
                  .text = in_words(pattern.text, row),
                  .colour = colour_of(row.text("algorithm")),
                  .is_outlined = pattern.is_outlined,
                  .tip = in_words(pattern.tip, row)};
    if (pattern.is_outlined) return bar;
    bar.is_open = row.text("bound") == ">";
    bar.is_missed = row.text("missed") == "true";
    const auto low = row.number("ci_low"), high = row.number("ci_high");
    if (has_interval(row) && high) bar.interval = page::Range{*low, *high};
    return bar;
}

page::Curve curve_of(const Rows& rows, const CurvePattern& pattern)
{
    const std::string algorithm = rows.front().text("algorithm");
    page::Curve curve{.name = algorithm,
                      .colour = colour_of(algorithm),
                      .width = pattern.is_line ? curve_width(algorithm) : 0.0,
                      .shows_points = pattern.shows_points};
    std::map<double, std::vector<double>> values;
    for (const TableRow& row : rows) {
        const auto x = row.number(pattern.x), y = row.number(pattern.y);
        if (!x || !y) continue;
        if (pattern.together == Together::each) curve.points.push_back({*x, *y});
        values[*x].push_back(*y);
    }
    if (pattern.together == Together::each) return curve;
    for (const auto& [x, all] : values) {
        const bool is_median = pattern.together == Together::median;
        curve.points.push_back({x, is_median ? metrics::median_of(all) : mean_of(all)});
        for (std::size_t i = 0; is_median && i < all.size(); ++i)
            curve.scatter.push_back({x, all[i]});
        if (is_median || all.size() < 2) continue;
        const auto [low, high] = metrics::interval_of_mean(all);
        curve.band.push_back({x, {low, high}});
    }
    return curve;
}

} // namespace

double mean_of(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::vector<std::string> distinct(const Rows& rows, std::string_view key)
{
    std::vector<std::string> found;
    for (const TableRow& row : rows) {
        std::string text = row.text(key);
        if (std::ranges::find(found, text) == found.end()) found.push_back(std::move(text));
    }
    return found;
}

Rows where(const Rows& rows, std::string_view key, std::string_view text)
{
    Rows kept;
    std::ranges::copy_if(rows, std::back_inserter(kept),
                         [&](const TableRow& row) { return row.text(key) == text; });
    return kept;
}

std::vector<Rows> split(const Rows& rows, std::span<const std::string_view> keys)
{
    std::vector<std::vector<std::string>> known;
    std::vector<Rows> parts;
    for (const TableRow& row : rows) {
        std::vector<std::string> texts;
        for (const std::string_view key : keys) texts.push_back(row.text(key));
        const auto found = std::ranges::find(known, texts);
        const auto place = static_cast<std::size_t>(found - known.begin());
        if (found == known.end()) {
            known.push_back(std::move(texts));
            parts.emplace_back();
        }
        parts[place].push_back(row);
    }
    return parts;
}

Table with_column(Table table, std::string key,
                  const std::function<results::Cell(const TableRow&)>& cell_of)
{
    std::vector<results::Cell> cells;
    for (const TableRow& row : rows_of(table)) cells.push_back(cell_of(row));
    table.columns.push_back({std::move(key)});
    for (std::size_t i = 0; i < cells.size(); ++i) table.rows[i].push_back(std::move(cells[i]));
    return table;
}

std::string shown(std::optional<double> value, int decimals)
{
    if (!value) return "–";
    // Avoids "-0.00": a value that rounds to zero at that many decimals has no sign.
    const bool is_nothing = std::abs(*value) < 0.5 * std::pow(10.0, -decimals);
    return fmt::format("{:.{}f}", is_nothing ? 0.0 : *value, decimals);
}

bool has_interval(const TableRow& row)
{
    return row.number("ci_low") && row.number("seeds").value_or(2.0) > 1.0;
}

double curve_width(std::string_view algorithm) { return algorithm == "sep" ? 4.0 : 1.2; }

std::string about_spread(double seeds)
{
    if (seeds < 2.0) return "";
    if (seeds >= metrics::interval_seeds_min) return "its 95 % interval";
    return fmt::format("from the least to the most of the {:g} seeds", seeds);
}

std::string people_say(std::string_view name)
{
    const auto* const found =
        std::ranges::find(names_for_people, name, [](const auto& one) { return one.first; });
    return std::string{found == names_for_people.end() ? name : found->second};
}

std::string in_words(std::string_view pattern, const TableRow& row)
{
    std::string words;
    for (;;) {
        const auto open = pattern.find('{');
        words += pattern.substr(0, open);
        if (open == std::string_view::npos) return words;
        const auto close = pattern.find('}', open);
        const auto inside = pattern.substr(open + 1, close - open - 1);
        const auto colon = std::min(inside.find(':'), inside.size());
        words += cell_in_words(row, inside.substr(0, colon),
                               inside.substr(std::min(colon + 1, inside.size())));
        pattern.remove_prefix(close + 1);
    }
}

std::string_view colour_of(std::string_view algorithm)
{
    constexpr std::array<std::pair<std::string_view, std::string_view>, 8> known{
        {{"base", "base"},
         {"sep", "sep"},
         {"dead-reckoning", "dead-reckoning"},
         {"base-tdpa", "calibrated"},
         {"wave", "met"},
         {"couple", "static-cube"},
         {"lag", "muted"},
         {"rollback", "accent"}}};
    const auto* const found =
        std::ranges::find(known, algorithm, [](const auto& one) { return one.first; });
    return found == known.end() ? std::string_view{"other"} : found->second;
}

page::Bars bars_of(const Rows& rows, std::string_view group, std::span<const BarPattern> bars)
{
    page::Bars groups;
    for (const TableRow& row : rows) {
        const std::string name = in_words(group, row);
        auto found = std::ranges::find(groups, name, &page::BarGroup::name);
        if (found == groups.end()) {
            groups.push_back({name, {}});
            found = groups.end() - 1;
        }
        for (const BarPattern& bar : bars)
            if (row.number(bar.value)) found->bars.push_back(bar_of(bar, row));
    }
    return groups;
}

std::vector<page::Curve> curves_of(const Rows& rows, const CurvePattern& pattern)
{
    constexpr std::array<std::string_view, 1> by_algorithm{"algorithm"};
    std::vector<page::Curve> curves;
    for (const Rows& part : split(rows, by_algorithm)) curves.push_back(curve_of(part, pattern));
    std::erase_if(curves, [](const page::Curve& curve) { return curve.points.empty(); });
    return curves;
}

} // namespace hapnet::lab::report
