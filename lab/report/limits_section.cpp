// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"
#include "lab/results/paper.hpp"
#include "proto/plot/bars.hpp"

#include <spdlog/fmt/fmt.h>

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

std::string measured_text(const results::LimitRow& row)
{
    return limit_text(row.limit, row.is_open(), row.unit);
}

plot::Bar paper_bar(const results::LimitRow& row, double paper)
{
    return {.value = paper,
            .label = plain(paper),
            .colour = colour_of(row.algorithm),
            .is_outlined = true,
            .tip = fmt::format("{}, paper: {}", row.algorithm, limit_text(paper, false, row.unit))};
}

plot::Bar measured_bar(const results::LimitRow& row)
{
    return {.value = row.limit,
            .label = fmt::format("{}{}", row.is_open() ? "> " : "", plain(row.limit)),
            .colour = colour_of(row.algorithm),
            .is_open = row.is_open(),
            .is_missed = to_claim(row.status) == results::Claim::missed,
            .tip = fmt::format("{} in {}: {} {}", row.algorithm, row.task, measured_text(row),
                               claim_text(to_claim(row.status)))};
}

/// The worst of the tasks, beside the paper: one group for each algorithm.
std::string worst_bars(const std::vector<results::LimitRow>& rows)
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
    return plot::svg_bars({title, "left: paper, right: this run", unit_text(first.unit)}, groups,
                          {}, {440.0, 260.0});
}

/// Every task on its own: one group for each.
std::string task_bars(const std::vector<results::LimitRow>& rows)
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
    return plot::svg_bars({title, "", unit_text(first.unit)}, groups, legend, {440.0, 260.0});
}

/// Of the worst of the tasks, or of each.
std::string limits_table(const std::vector<results::LimitRow>& rows, bool of_worst)
{
    const std::string caption =
        fmt::format("Limits of {}: the last level that passed before the first that failed",
                    impairment_text(rows.front().impairment));
    HtmlTable table{caption, {"algorithm", "task", "limit", "paper", "band", "status"}};
    const auto add = [&](const results::LimitRow& row) {
        const bool is_missed = to_claim(row.status) == results::Claim::missed;
        const auto paper =
            row.paper_limit ? limit_text(*row.paper_limit, false, row.unit) : std::string{"–"};
        table.rows.push_back(
            {{escaped(row.algorithm)},
             {escaped(row.task), "name"},
             {escaped(measured_text(row)), is_missed ? "ours missed" : "ours"},
             {escaped(paper), "paper"},
             {std::string{results::limit_band(row.algorithm, row.impairment)}, "band"},
             {claim_badge(to_claim(row.status))}});
    };
    for (const results::LimitRow& row : rows) {
        if ((row.task == results::worst_task) == of_worst) add(row);
    }
    return html_of(table);
}

void add_impairment(Section& section, const std::vector<results::LimitRow>& rows)
{
    const std::string& impairment = rows.front().impairment;
    section.html +=
        fmt::format("<h3>{}</h3>\n<div class='panels'>\n", escaped(impairment_text(impairment)));
    section.add_figure("limit-" + impairment, worst_bars(rows),
                       "Dashed: the paper. Filled: this run; red where it misses. An arrow: it "
                       "never failed as far as was tried.");
    section.add_figure("limit-" + impairment + "-by-task", task_bars(rows),
                       "What is hard for one task is easy for another.");
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
        add_impairment(section, rows);
    }
    if (is_empty) return std::nullopt;
    return section;
}

} // namespace

std::optional<Section> fig6a_section(const results::Results& results)
{
    return limits_section(results,
                          {"fig6a", "Fig. 6a: tolerated delay and jitter",
                           "<p>Each limit is searched from below: the bar ends where the first "
                           "session fails.</p>\n"},
                          {"delay", "jitter"});
}

std::optional<Section> fig6b_section(const results::Results& results)
{
    return limits_section(results,
                          {"fig6b", "Fig. 6b: tolerated loss",
                           "<p>Random loss in percent; burst loss as messages lost in a row of "
                           "every 100.</p>\n"},
                          {"random-loss", "burst-loss"});
}

} // namespace hapnet::lab::report
