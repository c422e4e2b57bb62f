// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/paired.hpp"
#include "lab/report/figures.hpp"
#include "lab/report/patterns.hpp"
#include "lab/results/verdicts.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::report {

namespace {

using Keys = std::vector<std::string_view>;

constexpr page::Size panel{360.0, 240.0};

/// A measure that is drawn over the axis.
struct Measure {
    std::string_view key;
    std::string_view title; // title of the group of figures
    std::string_view label;
    std::string_view unit;
};
constexpr std::array measures{
    Measure{"mean_mm", "How far the two copies are apart on average", "mean distance", "mm"},
    Measure{"max_mm", "How far the two copies are apart at most", "largest distance", "mm"},
    Measure{"vibration_mm", "How much the body vibrates above 20 Hz", "all vibration of the body",
            "mm"},
    Measure{"stiffness_ratio", "How stiff the other side feels at 1 Hz, against one shared world",
            "stiffness", "ratio"},
    Measure{"force_vibration_n", "How much vibration above 20 Hz the network adds to the force",
            "force vibration added", "N"}};

/// A value of an axis as a number, its times in ms.
struct Number {
    double value = 0.0;
    std::string unit;
};

std::optional<Number> number_in(const std::string& text)
{
    Number number;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number.value);
    if (error != std::errc{}) return std::nullopt;
    number.unit = std::string{end, text.data() + text.size()};
    constexpr std::array<std::pair<std::string_view, double>, 4> times{
        {{"ns", 1e-6}, {"us", 1e-3}, {"ms", 1.0}, {"s", 1e3}}};
    for (const auto& [unit, in_ms] : times) {
        if (number.unit != unit) continue;
        return Number{number.value * in_ms, "ms"};
    }
    return number;
}

/// Returns the unit of all values of the axis; nullopt: they are words, or have several units.
std::optional<std::string> unit_in(const Rows& rows)
{
    std::optional<std::string> unit;
    for (const std::string& text : distinct(rows, "value")) {
        const auto number = number_in(text);
        if (!number || (unit && *unit != number->unit)) return std::nullopt;
        unit = number->unit;
    }
    return unit;
}

page::Axis axis_of(const Rows& rows, const std::optional<std::string>& unit)
{
    page::Axis axis{in_words("{parameter}", rows.front())};
    if (unit) axis.unit = unit->empty() ? "1" : *unit;
    return axis;
}

/// Returns a bar for each algorithm at each value, where the values are words: the mean, with its
/// interval.
page::Bars bars_of_means(const Rows& rows, std::string_view key)
{
    page::Bars groups;
    for (const Rows& at_value : split(rows, Keys{"value"})) {
        auto& group = groups.emplace_back(page::BarGroup{at_value.front().text("value"), {}});
        for (const Rows& alike : split(at_value, Keys{"algorithm"})) {
            std::vector<double> values;
            for (const TableRow& row : alike)
                if (const auto value = row.number(key)) values.push_back(*value);
            if (values.empty()) continue;
            const double mean = mean_of(values);
            const std::string algorithm = alike.front().text("algorithm");
            page::Bar bar{.series = algorithm,
                          .value = mean,
                          .text = fmt::format("{:.3g}", mean),
                          .colour = colour_of(algorithm),
                          .tip = fmt::format("{}, {}: {}", algorithm, group.name, shown(mean, 3))};
            if (values.size() > 1) {
                const auto [low, high] = metrics::interval_of_mean(values);
                bar.interval = page::Range{low, high};
                bar.tip += fmt::format(" ({} to {})", shown(low, 3), shown(high, 3));
            }
            group.bars.push_back(std::move(bar));
        }
    }
    std::erase_if(groups, [](const page::BarGroup& group) { return group.bars.empty(); });
    return groups;
}

/// Returns "Mean of 3 seeds; the band is ...". `all` are the rows of all tasks.
std::string caption_of(const Rows& rows, const Rows& all, std::string_view mark)
{
    const std::size_t seeds = distinct(rows, "seed").size();
    if (seeds > 1)
        return fmt::format("Mean of {} seeds; the {} is {}.", seeds, mark,
                           about_spread(static_cast<double>(seeds)));
    return distinct(all, "seed").size() > 1 ? "Every seed plays the same session here."
                                            : "One seed.";
}

/// Returns the figure of one measure in one task; nullopt: it was not measured.
std::optional<page::Figure> figure_of(const Rows& rows, const Measure& measure,
                                      const std::optional<std::string>& unit)
{
    const TableRow& first = rows.front();
    page::Figure figure{.id = page::plain_id(fmt::format("axis-{}-{}-{}", first.text("parameter"),
                                                         first.text("task"), measure.key)),
                        .title = "Task " + first.text("task"),
                        .x = axis_of(rows, unit),
                        .y = {std::string{measure.label},
                              std::string{measure.unit},
                              page::Scale::linear,
                              {0.0, 0.0}},
                        .content = page::Curves{},
                        .size = panel};
    if (!unit) {
        auto bars = bars_of_means(rows, measure.key);
        if (bars.empty()) return std::nullopt;
        figure.content = std::move(bars);
        return figure;
    }
    auto curves = curves_of(
        rows,
        {.x = "value_number", .y = measure.key, .together = Together::mean, .shows_points = true});
    if (curves.empty()) return std::nullopt;
    figure.content = page::Curves{std::move(curves)};
    return figure;
}

/// Returns the figure of the worst task's limits over the values of a parameter.
page::Figure figure_of_limits(const Rows& rows, const std::optional<std::string>& unit)
{
    const TableRow& first = rows.front();
    page::Figure figure{
        .id = page::plain_id(
            fmt::format("axis-{}-{}", first.text("parameter"), first.text("impairment"))),
        .title = in_words("Limit of {impairment}, worst of the tasks", first),
        .x = axis_of(rows, unit),
        .y = {"limit", in_words("{unit}", first), page::Scale::linear, {0.0, 0.0}},
        .content = page::Curves{},
        .size = {440.0, 260.0},
        .caption = in_words("Limit of {impairment} by the {parameter}, {seeds} seeds", first)};
    if (const auto spread = about_spread(first.number("seeds").value_or(0.0)); !spread.empty())
        figure.caption = fmt::format("{}; the {} is {}", figure.caption.get<std::string>(),
                                     unit ? "band" : "line", spread);
    if (!unit) {
        figure.content = bars_of(rows, "{value}",
                                 std::array{BarPattern{"{algorithm}", "limit", "{limit:limit}",
                                                       "{algorithm}, {value}"}});
        return figure;
    }
    auto curves = curves_of(rows, {.x = "value_number", .y = "limit", .shows_points = true});
    for (page::Curve& curve : curves) {
        for (const TableRow& row : where(rows, "algorithm", curve.name)) {
            const auto x = row.number("value_number"), low = row.number("ci_low");
            const double high = row.number("ci_high").value_or(row.number("limit").value_or(0.0));
            if (x && low && has_interval(row)) curve.band.push_back({*x, {*low, high}});
        }
    }
    figure.content = page::Curves{std::move(curves)};
    return figure;
}

/// Returns the mean of a measure if all sessions of a value have it.
std::optional<double> mean_at(const Rows& rows, std::string_view key)
{
    std::vector<double> values;
    for (const TableRow& row : rows)
        if (const auto value = row.number(key)) values.push_back(*value);
    return values.empty() ? std::nullopt : std::optional{mean_of(values)};
}

/// Returns the kind of a send policy: "every" or "deadband".
std::string kind_of(const std::string& sending) { return sending.substr(0, sending.find(':')); }

/// Returns a figure of a measure over the traffic that each send policy needs: for each algorithm a
/// curve of fixed rates and one of deadbands. nullopt: it was not measured.
std::optional<page::Figure> frontier_of(const Rows& rows, const Measure& measure)
{
    const TableRow& first = rows.front();
    std::vector<page::Curve> curves;
    for (const Rows& played : split(rows, Keys{"algorithm"})) {
        const std::string algorithm = played.front().text("algorithm");
        for (const Rows& at_value : split(played, Keys{"value"})) {
            const auto rate = mean_at(at_value, "rate_kbit_s"), y = mean_at(at_value, measure.key);
            if (!rate || !y) continue;
            const std::string kind = kind_of(at_value.front().text("value"));
            const std::string name = fmt::format("{}, {}", algorithm, kind);
            auto curve = std::ranges::find(curves, name, &page::Curve::name);
            if (curve == curves.end()) {
                curve = curves.insert(curve, {.name = name, .colour = colour_of(algorithm)});
                curve->is_dashed = kind != "every";
                curve->shows_points = true;
            }
            curve->points.push_back({*rate, *y});
        }
    }
    if (curves.empty()) return std::nullopt;
    for (page::Curve& curve : curves) std::ranges::sort(curve.points, {}, &page::Point::x);
    return page::Figure{
        .id = page::plain_id(fmt::format("rate-{}-{}", first.text("task"), measure.key)),
        .title = "Task " + first.text("task"),
        .x = {"rate of the busiest direction", "kbit/s", page::Scale::logarithmic},
        .y = {std::string{measure.label}, std::string{measure.unit}},
        .content = page::Curves{std::move(curves)},
        .size = panel,
        .caption = "Each point is a way of sending, the mean of its seeds; dashed: deadbands."};
}

/// Adds figures of each measure over the rate of the network, where send policies were compared.
void add_frontiers(const Rows& rows, const std::vector<std::string>& sources, FigureGroups& groups)
{
    if (rows.front().text("parameter") != "send") return;
    for (const Measure& measure : measures) {
        FigureGroup group{std::string{measure.title} + ", by the rate", {}};
        for (const Rows& of_task : split(rows, Keys{"task"})) {
            auto figure = frontier_of(of_task, measure);
            if (!figure) continue;
            figure->sources = sources;
            group.figures.push_back(*std::move(figure));
        }
        if (!group.figures.empty()) groups.push_back(std::move(group));
    }
}

Table with_numbers(const Table& table)
{
    return with_column(table, "value_number", [](const TableRow& row) -> results::Cell {
        const auto number = number_in(row.text("value"));
        return number ? results::to_cell(number->value) : results::Cell{};
    });
}

void add_limits(const results::Results& results, FigureGroups& groups)
{
    const Table limits = with_numbers(results.table("limits_by_axis"));
    FigureGroup group;
    Rows worst = where(rows_of(limits), "task", results::worst_task);
    std::erase_if(worst, [](const TableRow& row) { return row.text("tier") == "good"; });
    for (const Rows& rows : split(worst, Keys{"parameter", "impairment"})) {
        group.figures.push_back(figure_of_limits(rows, unit_in(rows)));
        group.figures.back().sources = results.files_of("limits_by_axis");
    }
    if (!group.figures.empty()) groups.push_back(std::move(group));
}

} // namespace

FigureGroups axis_figures(const results::Results& results)
{
    FigureGroups groups;
    add_limits(results, groups);
    // The sessions of a search for limits were played at many levels, and are not drawn.
    if (results.table("table1_by_axis").is_empty()) return groups;
    const Table table = with_numbers(results.table("sessions_by_axis"));
    for (const Rows& rows : split(rows_of(table), Keys{"parameter"})) {
        const auto unit = unit_in(rows);
        add_frontiers(rows, results.files_of("sessions_by_axis"), groups);
        for (const Measure& measure : measures) {
            FigureGroup group{std::string{measure.title}, {}};
            for (const Rows& of_task : split(rows, Keys{"task"})) {
                auto figure = figure_of(of_task, measure, unit);
                if (!figure) continue;
                figure->caption = caption_of(of_task, rows, unit ? "band" : "line");
                figure->sources = results.files_of("sessions_by_axis");
                group.figures.push_back(*std::move(figure));
            }
            if (group.figures.empty()) continue;
            groups.push_back(std::move(group));
        }
    }
    return groups;
}

} // namespace hapnet::lab::report
