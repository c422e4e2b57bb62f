// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"
#include "lab/results/paper.hpp"
#include "proto/plot/bars.hpp"
#include "proto/plot/plot.hpp"

#include <map>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::report {

using plot::escaped;

namespace {

std::vector<results::LimitRow> limits_of(const results::Results& results,
                                         std::string_view impairment)
{
    std::vector<results::LimitRow> rows;
    for (const results::LimitRow& row : results.limits) {
        if (row.impairment == impairment) rows.push_back(row);
    }
    return rows;
}

/// As many digits as a limit is worth.
std::string rounded(double limit) { return shown(limit, limit < 20.0 ? 1 : 0); }

std::string measured_text(const results::LimitRow& row)
{
    return fmt::format("{}{} {}", row.is_open() ? "> " : "", rounded(row.limit),
                       unit_text(row.unit));
}

plot::Bar paper_bar(const results::LimitRow& row, double paper)
{
    return {.value = paper,
            .label = plain(paper),
            .colour = colour_of(row.algorithm),
            .is_outlined = true,
            .tip = fmt::format("{}, paper: {}", row.algorithm, limit_text(paper, false, row.unit))};
}

/// "157 … 163 ms"; an end beyond the range is open.
std::string interval_text(const results::LimitRow& row)
{
    if (!row.ci_low) return "–";
    const auto high = row.ci_high ? shown(row.ci_high, 1) : "> " + shown(row.p50, 1);
    return fmt::format("{} … {}", shown(row.ci_low, 1), high);
}

plot::Bar measured_bar(const results::LimitRow& row)
{
    plot::Bar bar{.value = row.limit,
                  .label = fmt::format("{}{}", row.is_open() ? "> " : "", rounded(row.limit)),
                  .colour = colour_of(row.algorithm),
                  .is_open = row.is_open(),
                  .is_missed = to_claim(row.status) == results::Claim::missed,
                  .tip = fmt::format("{} in {}: {} ({}, {} seeds) {}", row.algorithm, row.task,
                                     measured_text(row), interval_text(row), row.seeds,
                                     base::name_of(row.status))};
    if (row.ci_low && row.ci_high) bar.interval = plot::Range{*row.ci_low, *row.ci_high};
    return bar;
}

/// The worst of the tasks, beside the paper: one group for each algorithm.
Drawing worst_bars(const std::vector<results::LimitRow>& rows)
{
    std::vector<plot::BarGroup> groups;
    for (const results::LimitRow& row : rows) {
        if (row.task != results::worst_task) continue;
        plot::BarGroup group{row.algorithm, {}};
        if (row.paper_limit) group.bars.push_back(paper_bar(row, *row.paper_limit));
        group.bars.push_back(measured_bar(row));
        groups.push_back(std::move(group));
    }
    const auto& first = rows.front();
    const std::string title =
        fmt::format("Limit of {}, worst of the tasks", impairment_text(first.impairment));
    return drawn_bars({title, "left: paper, right: this run", unit_text(first.unit)}, groups, {},
                      {440.0, 260.0});
}

/// Every task on its own: one group for each.
Drawing task_bars(const std::vector<results::LimitRow>& rows)
{
    std::vector<plot::BarGroup> groups;
    std::vector<plot::LegendEntry> legend;
    for (const std::string& task : distinct(rows, [](const auto& row) { return row.task; })) {
        if (task == results::worst_task) continue;
        plot::BarGroup group{task, {}};
        for (const results::LimitRow& row : rows) {
            if (row.task == task) group.bars.push_back(measured_bar(row));
        }
        groups.push_back(std::move(group));
    }
    const auto names = distinct(rows, [](const auto& row) { return row.algorithm; });
    for (const std::string& name : names) legend.push_back({name, colour_of(name)});
    const auto& first = rows.front();
    const std::string title = fmt::format("Limit of {} by task", impairment_text(first.impairment));
    return drawn_bars({title, "", unit_text(first.unit)}, groups, legend, {440.0, 260.0});
}

/// Of the worst of the tasks, or of each.
std::string limits_table(const std::vector<results::LimitRow>& rows, bool of_worst)
{
    const std::string caption =
        fmt::format("Limits of {}: the level at which half of the seeds fail, its 95 % interval, "
                    "and the level at which a tenth fails",
                    impairment_text(rows.front().impairment));
    HtmlTable table{caption,
                    {"algorithm", "task", "limit", "95 %", "a tenth", "seeds", "paper", "band",
                     "status", "class"}};
    const auto add = [&](const results::LimitRow& row) {
        const bool is_missed = to_claim(row.status) == results::Claim::missed;
        const auto paper =
            row.paper_limit ? limit_text(*row.paper_limit, false, row.unit) : std::string{"–"};
        table.rows.push_back(
            {{escaped(row.algorithm)},
             {escaped(row.task), "name"},
             {escaped(measured_text(row)), is_missed ? "ours missed" : "ours"},
             {escaped(interval_text(row))},
             {shown(row.p10, 1)},
             {std::to_string(row.seeds)},
             {escaped(paper), "paper"},
             {of_worst ? std::string{results::limit_band(row.algorithm, row.impairment)} : "",
              "band"},
             {status_badge(row.status)},
             {class_badge(row.provenance)}});
    };
    for (const results::LimitRow& row : rows) {
        if ((row.task == results::worst_task) == of_worst) add(row);
    }
    return html_of(table);
}

/// At each level the share of the seeds that fail, in the task that bears least.
Drawing failing_plot(const results::Results& results, const std::vector<results::LimitRow>& rows)
{
    const auto names = distinct(rows, [](const auto& row) { return row.algorithm; });
    std::vector<plot::Curve> curves;
    for (const std::string& name : names) {
        const results::LimitRow* least = nullptr;
        for (const results::LimitRow& row : rows) {
            const bool is_task = row.algorithm == name && row.task != results::worst_task;
            if (is_task && (least == nullptr || row.limit < least->limit)) least = &row;
        }
        if (least == nullptr) continue;
        std::map<double, std::pair<double, double>> levels; // failed, of
        for (const results::CurveRow& point : results.curves) {
            if (point.algorithm != name || point.impairment != least->impairment ||
                point.task != least->task || !point.counts)
                continue;
            auto& [failed, all] = levels[point.level];
            failed += point.judged.tier == metrics::Tier::unusable ? 1.0 : 0.0;
            all += 1.0;
        }
        plot::Curve curve{.name = name,
                          .colour = colour_of(name),
                          .width = curve_width(name),
                          .shows_points = true};
        for (const auto& [level, count] : levels)
            curve.points.push_back({level, 100.0 * count.first / count.second});
        if (!curve.points.empty()) curves.push_back(std::move(curve));
    }
    if (curves.empty()) return {};
    const auto& first = rows.front();
    const std::string across =
        fmt::format("{}, {}", impairment_text(first.impairment), unit_text(first.unit));
    return drawn_plot({"Seeds that fail, in the task that bears least", across, "%"}, curves,
                      {.size = {440.0, 260.0}, .levels = {{50.0, "limit"}}, .y = {0.0, 100.0}});
}

void add_impairment(Section& section, const results::Results& results,
                    const std::vector<results::LimitRow>& rows)
{
    const std::string& impairment = rows.front().impairment;
    section.html +=
        fmt::format("<h3>{}</h3>\n<div class='panels'>\n", escaped(impairment_text(impairment)));
    section.sources = links_to(results, "limits.csv");
    section.add_figure("limit-" + impairment, worst_bars(rows),
                       fmt::format("Dashed: the paper, where it states a number. Filled: this run, "
                                   "{} seeds; the line is the 95 % interval. Red where it misses. "
                                   "An arrow: half never failed as far as was tried.",
                                   rows.front().seeds));
    section.add_figure("limit-" + impairment + "-by-task", task_bars(rows),
                       "What is hard for one task is easy for another.");
    section.sources = links_to(results, "curves.csv");
    if (auto failing = failing_plot(results, rows); !failing.svg.empty()) {
        section.add_figure("failing-" + impairment, std::move(failing),
                           "A point: all seeds at one level.");
    }
    section.html += "</div>\n" + limits_table(rows, true) +
                    folded("Each task on its own", limits_table(rows, false));
}

std::optional<Section> limits_section(const results::Results& results, Section section,
                                      const std::vector<std::string_view>& impairments)
{
    bool is_empty = true;
    for (const std::string_view impairment : impairments) {
        const auto rows = limits_of(results, impairment);
        if (rows.empty()) continue;
        is_empty = false;
        add_impairment(section, results, rows);
    }
    if (is_empty) return std::nullopt;
    return section;
}

} // namespace

std::optional<Section> fig6a_section(const results::Results& results)
{
    return limits_section(results,
                          {"fig6a", "Fig. 6a: tolerated delay and jitter",
                           "<p>A limit is the level at which half of the sessions fail in the task "
                           "that bears least: all seeds are played at eight levels, and a "
                           "psychometric curve is fitted to how many fail.</p>\n"},
                          {"delay", "jitter"});
}

std::optional<Section> fig6b_section(const results::Results& results)
{
    return limits_section(results,
                          {"fig6b", "Fig. 6b: tolerated loss",
                           "<p>Random loss in percent; burst loss as messages lost in a row of "
                           "every 100. The path has no delay of its own.</p>\n"},
                          {"random-loss", "burst-loss"});
}

} // namespace hapnet::lab::report
