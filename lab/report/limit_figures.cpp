// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/psychometric.hpp"
#include "lab/report/figures.hpp"
#include "lab/report/patterns.hpp"
#include "lab/results/verdicts.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::report {

namespace {

using Keys = std::vector<std::string_view>;

constexpr page::Size half_of_width{440.0, 260.0};

/// Returns the limits, with descriptions of the searches' findings.
Table with_words(const Table& limits)
{
    Table table = with_column(limits, "above", [](const TableRow& row) -> results::Cell {
        return std::string{row.text("bound") == ">" ? "> " : ""};
    });
    return with_column(std::move(table), "interval", [](const TableRow& row) -> results::Cell {
        if (!has_interval(row)) return std::string{"–"};
        return in_words(
            row.number("ci_high") ? "{ci_low:.1} … {ci_high:.1}" : "{ci_low:.1} … > {p50:.1}", row);
    });
}

page::Figure figure_of_limits(std::string id, std::string_view title, const TableRow& first,
                              page::Bars groups)
{
    return {.id = page::plain_id(std::move(id)),
            .title = in_words(title, first),
            .x = {"algorithm"},
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

/// Returns the figure of the worst task's limits, beside the paper's.
page::Figure worst_figure(const Rows& rows)
{
    const std::array bars{BarPattern{"paper", "paper_limit", "{paper_limit:g}",
                                     "{algorithm}, paper: {paper_limit:g} {unit}", true},
                          measured("this run")};
    auto figure = figure_of_limits(
        "limit-" + rows.front().text("impairment"), "Limit of {impairment}, worst of the tasks",
        rows.front(), bars_of(where(rows, "task", results::worst_task), "{algorithm}", bars));
    const bool has_paper = std::ranges::any_of(
        rows, [](const TableRow& row) { return row.number("paper_limit").has_value(); });
    const auto spread = about_spread(rows.front().number("seeds").value_or(0.0));
    figure.caption = fmt::format("{}{}. An arrow: half never failed as far as was tried.",
                                 in_words("{seeds} seeds", rows.front()),
                                 spread.empty() ? "" : "; the line is " + spread);
    if (has_paper)
        figure.caption = "Dashed: the paper, where it states a number. Red where this run misses "
                         "it. " +
                         figure.caption.get<std::string>();
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
    figure.x.label = "task";
    figure.caption = "What is hard for one task is easy for another.";
    return figure;
}

/// Returns the row with the least limit of each group of rows with equal texts in these columns.
Rows least_limits(const Rows& rows, const Keys& keys)
{
    Rows least;
    for (const Rows& alike : split(rows, keys)) {
        least.push_back(*std::ranges::min_element(
            alike, {}, [](const TableRow& row) { return row.number("limit").value_or(0.0); }));
    }
    return least;
}

/// Returns the share of the sessions that fail at each level, the fitted curve, and its crossing of
/// one half with the interval. `limit` is that of one task.
page::Curve failing_curve(const TableRow& limit, const Rows& sessions)
{
    std::map<double, metrics::FailCount> counts;
    for (const TableRow& row : sessions) {
        const auto level = row.number("level");
        if (!level) continue;
        auto& count = counts.try_emplace(*level, metrics::FailCount{*level}).first->second;
        count.of += 1.0;
        if (row.text("tier") == "unusable") count.failed += 1.0;
    }
    const std::string algorithm = limit.text("algorithm");
    page::Curve curve{.name = fmt::format("{} in {}", algorithm, limit.text("task")),
                      .colour = colour_of(algorithm),
                      .width = curve_width(algorithm)};
    std::vector<metrics::FailCount> fails;
    for (const auto& [level, count] : counts) {
        fails.push_back(count);
        curve.scatter.push_back({level, 100.0 * count.failed / count.of});
    }
    if (fails.size() < 2) return curve;
    constexpr int steps = 120;
    const auto fit = metrics::fitted(fails);
    const double first = fails.front().level, last = fails.back().level;
    for (int i = 0; i <= steps; ++i) {
        const double level = first + (last - first) * i / steps;
        curve.points.push_back({level, 100.0 * fit.share_at(level)});
    }
    if (const auto low = limit.number("ci_low"); has_interval(limit) && limit.text("bound") == "=")
        curve.crossing = page::Crossing{50.0, {*low, limit.number("ci_high").value_or(last)}};
    return curve;
}

/// Draws for each algorithm the share of the seeds that fail at each level, in the task with the
/// least limit.
std::optional<page::Figure> failing_figure(const Rows& limits, const Rows& curves)
{
    std::vector<page::Curve> drawn;
    for (const TableRow& least : least_limits(single_tasks(limits), {"algorithm"})) {
        Rows sessions = curves;
        for (const std::string_view key : {"algorithm", "impairment", "task"})
            sessions = where(sessions, key, least.text(key));
        auto curve = failing_curve(least, sessions);
        if (!curve.scatter.empty()) drawn.push_back(std::move(curve));
    }
    if (drawn.empty()) return std::nullopt;
    const auto spread = about_spread(limits.front().number("seeds").value_or(0.0));
    return page::Figure{
        .id = page::plain_id("failing-" + limits.front().text("impairment")),
        .title = in_words("Sessions that fail as {impairment} grows", limits.front()),
        .x = {in_words("{impairment}", limits.front()), in_words("{unit}", limits.front())},
        .y = {"sessions that fail", "%", page::Scale::linear, {0.0, 100.0}},
        .content = page::Curves{std::move(drawn), {{50.0, "half fail"}}},
        .size = {900.0, 300.0},
        .caption = fmt::format(
            "Each algorithm in the task that bears least. A point: all seeds at one level. The "
            "curve is fitted to the points; the limit is where it crosses one half{}. No bar: half "
            "never failed as far as was tried.",
            spread.empty() ? "" : ", and the bar there is " + spread)};
}

/// Returns the limits of the tier that figures show and that the paper has.
Rows usable_limits(Rows rows)
{
    std::erase_if(rows, [](const TableRow& row) { return row.text("tier") == "good"; });
    return rows;
}

FigureGroups limits_figures(const results::Results& results, const Keys& impairments)
{
    const Table limits = with_column(with_words(results.table("limits")), "missed",
                                     [](const TableRow& row) -> results::Cell {
                                         return row.text("status").ends_with("missed");
                                     });
    const Rows sessions = where(results.rows("curves"), "counts", "true");
    FigureGroups groups;
    for (const std::string_view impairment : impairments) {
        const Rows rows = usable_limits(where(rows_of(limits), "impairment", impairment));
        if (rows.empty()) continue;
        auto& group = groups.emplace_back(FigureGroup{in_words("{impairment}", rows.front()), {}});
        if (auto failing = failing_figure(rows, sessions)) {
            failing->sources = results.files_of("curves");
            group.figures.push_back(*std::move(failing));
        }
        group.figures.push_back(worst_figure(rows));
        group.figures.push_back(by_task_figure(rows));
    }
    return groups;
}

/// A criterion of a session, drawn over the level.
struct Criterion {
    std::string_view name;
    std::string_view title;
    std::string_view unit;
    std::string_view key;
    page::Scale scale;
    double (*threshold)(const metrics::Criteria&); // limit of a usable session
};

constexpr std::array criteria_drawn{
    Criterion{"vibration", "Vibration of the cube above 20 Hz", "mm", "vibration_mm",
              page::Scale::logarithmic,
              [](const metrics::Criteria& c) {
                  return 1e3 * at_order(c.usable.vibration_max_m, c.filter_order);
              }},
    Criterion{"stiffness", "Error of the stiffness felt at 0.5 Hz, against one shared world",
              "ratio", "slow_stiffness_error", page::Scale::linear,
              [](const metrics::Criteria& c) { return c.usable.slow_stiffness_error_max; }},
    Criterion{"force-vibration", "Vibration of the force above 20 Hz", "N", "force_vibration_n",
              page::Scale::logarithmic,
              [](const metrics::Criteria& c) { return c.usable.force_vibration_max_n; }}};

/// Adds a figure with a point for each seed, and a line through the medians. `rows` are of one
/// impairment and task.
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

FigureGroups requirements_figures(const results::Results& results)
{
    return limits_figures(results, {"interval"});
}

FigureGroups curves_figures(const results::Results& results)
{
    FigureGroups groups;
    for (const Rows& rows : split(results.rows("curves"), Keys{"impairment"})) {
        auto& group = groups.emplace_back(FigureGroup{in_words("{impairment}", rows.front()), {}});
        // Each task has its own figure: a line through the worst of several would jump between
        // them.
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

} // namespace hapnet::lab::report
