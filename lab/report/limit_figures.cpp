// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/figures.hpp"
#include "lab/report/patterns.hpp"
#include "lab/results/verdicts.hpp"

#include <algorithm>
#include <array>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::report {

namespace {

using Keys = std::vector<std::string_view>;

constexpr page::Size half_of_width{440.0, 260.0};

/// Limits, with words about what each found.
Table with_words(const Table& limits)
{
    Table table = with_column(limits, "above", [](const TableRow& row) -> results::Cell {
        return std::string{row.text("bound") == ">" ? "> " : ""};
    });
    return with_column(std::move(table), "interval", [](const TableRow& row) -> results::Cell {
        if (!row.number("ci_low")) return std::string{"–"};
        return in_words(
            row.number("ci_high") ? "{ci_low:.1} … {ci_high:.1}" : "{ci_low:.1} … > {p50:.1}", row);
    });
}

page::Figure figure_of_limits(std::string id, std::string_view title, const TableRow& first,
                              page::Bars groups)
{
    return {.id = page::plain_id(std::move(id)),
            .title = in_words(title, first),
            .x = {""},
            .y = {"limit", in_words("{unit}", first)},
            .content = std::move(groups),
            .size = half_of_width};
}

BarPattern measured(std::string series)
{
    return {std::move(series), "limit", "{above}{limit:limit}",
            "{algorithm} in {task}: {above}{limit:limit} {unit} ({interval}, {seeds} seeds) "
            "{status}"};
}

/// The worst of the tasks, beside the paper.
page::Figure worst_figure(const Rows& rows)
{
    const std::array bars{BarPattern{"paper", "paper_limit", "{paper_limit:g}",
                                     "{algorithm}, paper: {paper_limit:g} {unit}", true},
                          measured("this run")};
    auto figure = figure_of_limits(
        "limit-" + rows.front().text("impairment"), "Limit of {impairment}, worst of the tasks",
        rows.front(), bars_of(where(rows, "task", results::worst_task), "{algorithm}", bars));
    figure.x.label = "left: paper, right: this run";
    figure.caption =
        in_words("Dashed: the paper, where it states a number. Filled: this run, {seeds} seeds; "
                 "the line is the 95 % interval. Red where it misses. An arrow: half never failed "
                 "as far as was tried.",
                 rows.front());
    return figure;
}

Rows single_tasks(Rows rows)
{
    std::erase_if(rows,
                  [](const TableRow& row) { return row.text("task") == results::worst_task; });
    return rows;
}

page::Figure by_task_figure(const Rows& rows)
{
    auto figure = figure_of_limits(
        fmt::format("limit-{}-by-task", rows.front().text("impairment")),
        "Limit of {impairment} by task", rows.front(),
        bars_of(single_tasks(rows), "{task}", std::array{measured("{algorithm}")}));
    figure.caption = "What is hard for one task is easy for another.";
    return figure;
}

/// Of the rows that these columns tell apart, that with the least limit.
Rows least_limits(const Rows& rows, const Keys& keys)
{
    Rows least;
    for (const Rows& alike : split(rows, keys)) {
        least.push_back(*std::ranges::min_element(
            alike, {}, [](const TableRow& row) { return row.number("limit").value_or(0.0); }));
    }
    return least;
}

/// At each level the share of the seeds that fail, in the task that bears least.
std::optional<page::Figure> failing_figure(const Rows& limits, const Rows& curves)
{
    Rows sessions;
    const std::string impairment = limits.front().text("impairment");
    for (const TableRow& least : least_limits(single_tasks(limits), {"algorithm"})) {
        for (const TableRow& row : curves) {
            const auto is_same = [&](std::string_view key) {
                return row.text(key) == least.text(key);
            };
            if (is_same("algorithm") && is_same("impairment") && is_same("task"))
                sessions.push_back(row);
        }
    }
    auto drawn = curves_of(
        sessions, {.x = "level", .y = "failed", .together = Together::mean, .shows_points = true});
    if (drawn.empty()) return std::nullopt;
    return page::Figure{
        .id = page::plain_id("failing-" + impairment),
        .title = "Seeds that fail, in the task that bears least",
        .x = {in_words("{impairment}", limits.front()), in_words("{unit}", limits.front())},
        .y = {"seeds that fail", "%", page::Scale::linear, {0.0, 100.0}},
        .content = page::Curves{std::move(drawn), {{50.0, "limit"}}},
        .size = half_of_width,
        .caption = "A point: all seeds at one level."};
}

FigureGroups limits_figures(const results::Results& results, const Keys& impairments)
{
    const Table limits = with_column(with_words(results.table("limits")), "missed",
                                     [](const TableRow& row) -> results::Cell {
                                         return row.text("status").ends_with("missed");
                                     });
    const Table curves =
        with_column(results.table("curves"), "failed", [](const TableRow& row) -> results::Cell {
            return row.text("tier") == "unusable" ? 100.0 : 0.0;
        });
    const Rows sessions = where(rows_of(curves), "counts", "true");
    FigureGroups groups;
    for (const std::string_view impairment : impairments) {
        const Rows rows = where(rows_of(limits), "impairment", impairment);
        if (rows.empty()) continue;
        auto& group = groups.emplace_back(FigureGroup{in_words("{impairment}", rows.front()), {}});
        group.figures = {worst_figure(rows), by_task_figure(rows)};
        if (auto failing = failing_figure(rows, sessions)) {
            failing->sources = results.files_of("curves");
            group.figures.push_back(*std::move(failing));
        }
    }
    return groups;
}

/// A criterion of a session, drawn against the level.
struct Criterion {
    std::string_view name;
    std::string_view title;
    std::string_view unit;
    std::string_view key;
    page::Scale scale;
    double (*threshold)(const metrics::Criteria&); // of what is usable
};

constexpr std::array criteria_drawn{
    Criterion{"vibration", "Vibration of the cube above 20 Hz", "mm", "vibration_mm",
              page::Scale::logarithmic,
              [](const metrics::Criteria& c) {
                  return 1e3 * at_order(c.usable.vibration_max_m, c.filter_order);
              }},
    Criterion{"stiffness", "Stiffness felt at 1 Hz", "of that at no delay", "stiffness_ratio",
              page::Scale::linear,
              [](const metrics::Criteria& c) { return c.usable.stiffness_ratio_min; }},
    Criterion{"force-vibration", "Vibration of the force above 20 Hz", "N", "force_vibration_n",
              page::Scale::logarithmic,
              [](const metrics::Criteria& c) { return c.usable.force_vibration_max_n; }}};

/// A point for each seed, and a line through the medians. `rows` are of one impairment and task.
void add_curve_figure(const Rows& rows, const Criterion& criterion,
                      const std::optional<metrics::Criteria>& criteria, FigureGroup& group)
{
    page::Curves content{
        curves_of(where(rows, "counts", "true"),
                  {.x = "level", .y = criterion.key, .together = Together::median})};
    if (content.curves.empty()) return;
    if (criteria) content.levels.push_back({criterion.threshold(*criteria), "usable"});
    const TableRow& first = rows.front();
    group.figures.push_back(
        {.id = page::plain_id(fmt::format("curve-{}-{}-{}", first.text("impairment"),
                                          first.text("task"), criterion.name)),
         .title = fmt::format("{}: {}", first.text("task"), criterion.name),
         .x = {in_words("{impairment}", first), in_words("{unit}", first)},
         .y = {std::string{criterion.name}, std::string{criterion.unit}, criterion.scale},
         .content = std::move(content),
         .size = {360.0, 250.0},
         .caption = fmt::format("{}: {}", first.text("task"), criterion.title)});
}

} // namespace

FigureGroups fig6a_figures(const results::Results& results)
{
    return limits_figures(results, {"delay", "jitter"});
}

FigureGroups fig6b_figures(const results::Results& results)
{
    return limits_figures(results, {"random-loss", "burst-loss"});
}

FigureGroups curves_figures(const results::Results& results)
{
    FigureGroups groups;
    for (const Rows& rows : split(results.rows("curves"), Keys{"impairment"})) {
        auto& group = groups.emplace_back(FigureGroup{in_words("{impairment}", rows.front()), {}});
        // Every task on its own: a line through the worst of several would jump between them.
        for (const Rows& of_task : split(rows, Keys{"task"}))
            for (const Criterion& criterion : criteria_drawn)
                add_curve_figure(of_task, criterion, results.criteria(), group);
    }
    return groups;
}

FigureGroups trust_figures(const results::Results& results)
{
    const std::array bars{BarPattern{"order {filter_order} {hand}", "limit", "{limit:limit}",
                                     "{algorithm}: order {filter_order}, {hand}, {seeds} seeds"}};
    FigureGroup group;
    for (const Rows& rows : split(results.rows("limits_by_convention"), Keys{"impairment"})) {
        auto& figure = group.figures.emplace_back(figure_of_limits(
            "trust-" + rows.front().text("impairment"), "Limit of {impairment}", rows.front(),
            bars_of(least_limits(rows, {"algorithm", "filter_order", "hand"}), "{algorithm}",
                    bars)));
        figure.size.width = 900.0;
        std::string methods;
        for (const Rows& alike : split(rows, Keys{"filter_order", "hand"}))
            methods += (methods.empty() ? "" : ", ") +
                       in_words("order {filter_order} {hand}", alike.front());
        figure.caption = fmt::format("Least of the tasks. From left to right: {}. An arrow: not "
                                     "reached within the range.",
                                     methods);
    }
    return {group};
}

FigureGroups axis_figures(const results::Results& results)
{
    const std::array bars{
        BarPattern{"{algorithm}", "limit", "{above}{limit:limit}", "{algorithm}, {value}"}};
    const Table limits = with_words(results.table("limits_by_axis"));
    FigureGroup group;
    for (const Rows& rows : split(rows_of(limits), Keys{"parameter", "impairment"})) {
        const TableRow& first = rows.front();
        const Rows worst = where(rows, "task", results::worst_task);
        auto& figure = group.figures.emplace_back(figure_of_limits(
            fmt::format("axis-{}-{}", first.text("parameter"), first.text("impairment")),
            "Limit of {impairment}", first, bars_of(worst, "{value}", bars)));
        figure.x.label = in_words("{parameter}", first);
        figure.caption = in_words("Limit of {impairment} by the {parameter}, {seeds} seeds", first);
    }
    return {group};
}

} // namespace hapnet::lab::report
