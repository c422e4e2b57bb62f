// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"
#include "lab/results/paper.hpp"

#include <map>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::report {

namespace {

std::string measured_text(const results::LimitRow& row)
{
    return fmt::format("{}{} {}", row.is_open() ? "> " : "", rounded_limit(row.limit),
                       unit_text(row.unit));
}

page::Bar paper_bar(const results::LimitRow& row, double paper)
{
    return {.series = "paper",
            .value = paper,
            .text = plain(paper),
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

page::Bar measured_bar(const results::LimitRow& row, std::string series)
{
    auto bar = limit_bar(row, std::move(series),
                         fmt::format("{} in {}: {} ({}, {} seeds) {}", row.algorithm, row.task,
                                     measured_text(row), interval_text(row), row.seeds,
                                     base::name_of(row.status)));
    bar.is_missed = to_claim(row.status) == results::Claim::missed;
    return bar;
}

page::Figure bars_of(const std::vector<results::LimitRow>& rows, std::string_view more,
                     page::Bars groups)
{
    const auto& first = rows.front();
    return {.id = page::plain_id(fmt::format("limit-{}", first.impairment)),
            .title = fmt::format("Limit of {}{}", impairment_text(first.impairment), more),
            .x = {""},
            .y = {"limit", std::string{unit_text(first.unit)}},
            .content = std::move(groups),
            .size = {440.0, 260.0}};
}

/// The worst of the tasks, beside the paper: one group for each algorithm.
page::Figure worst_bars(const std::vector<results::LimitRow>& rows)
{
    page::Bars groups;
    for (const results::LimitRow& row : rows) {
        if (row.task != results::worst_task) continue;
        page::BarGroup group{row.algorithm, {}};
        if (row.paper_limit) group.bars.push_back(paper_bar(row, *row.paper_limit));
        group.bars.push_back(measured_bar(row, "this run"));
        groups.push_back(std::move(group));
    }
    auto figure = bars_of(rows, ", worst of the tasks", std::move(groups));
    figure.x.label = "left: paper, right: this run";
    figure.caption =
        fmt::format("Dashed: the paper, where it states a number. Filled: this run, {} "
                    "seeds; the line is the 95 % interval. Red where it misses. An "
                    "arrow: half never failed as far as was tried.",
                    rows.front().seeds);
    return figure;
}

/// Every task on its own: one group for each.
page::Figure task_bars(const std::vector<results::LimitRow>& rows)
{
    page::Bars groups;
    for (const std::string& task : distinct(rows, [](const auto& row) { return row.task; })) {
        if (task == results::worst_task) continue;
        page::BarGroup group{task, {}};
        for (const results::LimitRow& row : rows) {
            if (row.task == task) group.bars.push_back(measured_bar(row, row.algorithm));
        }
        groups.push_back(std::move(group));
    }
    auto figure = bars_of(rows, " by task", std::move(groups));
    figure.id += "-by-task";
    figure.caption = "What is hard for one task is easy for another.";
    return figure;
}

/// Of the worst of the tasks, or of each.
Json limits_table(const std::vector<results::LimitRow>& rows, bool of_worst)
{
    const std::string caption =
        fmt::format("Limits of {}: the level at which half of the seeds fail, its 95 % interval, "
                    "and the level at which a tenth fails",
                    impairment_text(rows.front().impairment));
    page::Table table{caption,
                      {"algorithm", "task", "limit", "95 %", "a tenth", "seeds", "paper", "band",
                       "status", "class"}};
    const auto add = [&](const results::LimitRow& row) {
        const bool is_missed = to_claim(row.status) == results::Claim::missed;
        const auto paper =
            row.paper_limit ? limit_text(*row.paper_limit, false, row.unit) : std::string{"–"};
        table.rows.push_back(
            {{row.algorithm},
             {row.task, "name"},
             {measured_text(row), is_missed ? "ours missed" : "ours"},
             {interval_text(row)},
             {shown(row.p10, 1)},
             {std::to_string(row.seeds)},
             {paper, "paper"},
             {of_worst ? std::string{results::limit_band(row.algorithm, row.impairment)} : "",
              "band"},
             {status_badge(row.status)},
             {class_badge(row.provenance)}});
    };
    for (const results::LimitRow& row : rows) {
        if ((row.task == results::worst_task) == of_worst) add(row);
    }
    return json_of(table);
}

/// At each level the share of the seeds that fail, in the task that bears least.
std::optional<page::Figure> failing_figure(const results::Results& results,
                                           const std::vector<results::LimitRow>& rows)
{
    const auto names = distinct(rows, [](const auto& row) { return row.algorithm; });
    std::vector<page::Curve> curves;
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
        page::Curve curve{.name = name,
                          .colour = colour_of(name),
                          .width = curve_width(name),
                          .shows_points = true};
        for (const auto& [level, count] : levels)
            curve.points.push_back({level, 100.0 * count.first / count.second});
        if (!curve.points.empty()) curves.push_back(std::move(curve));
    }
    if (curves.empty()) return std::nullopt;
    const auto& first = rows.front();
    return page::Figure{
        .id = page::plain_id("failing-" + first.impairment),
        .title = "Seeds that fail, in the task that bears least",
        .x = {impairment_text(first.impairment), std::string{unit_text(first.unit)}},
        .y = {"seeds that fail", "%", page::Scale::linear, {0.0, 100.0}},
        .content = page::Curves{std::move(curves), {{50.0, "limit"}}},
        .size = {440.0, 260.0},
        .caption = "A point: all seeds at one level."};
}

void add_impairment(Section& section, const results::Results& results,
                    const std::vector<results::LimitRow>& rows)
{
    section.add(page::heading(impairment_text(rows.front().impairment)));
    section.sources = files_named(results, "limits.csv");
    Json figures = Json::array({section.keep(worst_bars(rows)), section.keep(task_bars(rows))});
    section.sources = files_named(results, "curves.csv");
    if (auto failing = failing_figure(results, rows))
        figures.push_back(section.keep(*std::move(failing)));
    section.add(page::panels("", std::move(figures)));
    section.add(limits_table(rows, true));
    section.add(page::folded("Each task on its own", Json::array({limits_table(rows, false)})));
}

std::optional<Section> limits_section(const results::Results& results, Section section,
                                      const std::vector<std::string_view>& impairments)
{
    bool is_empty = true;
    for (const std::string_view impairment : impairments) {
        const auto rows = rows_where(results.limits,
                                     [&](const auto& row) { return row.impairment == impairment; });
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
    Section section{"fig6a", "Fig. 6a: tolerated delay and jitter"};
    section.add(page::paragraph(
        "A limit is the level at which half of the sessions fail in the task that bears least: all "
        "seeds are played at eight levels, and a psychometric curve is fitted to how many fail."));
    return limits_section(results, std::move(section), {"delay", "jitter"});
}

std::optional<Section> fig6b_section(const results::Results& results)
{
    Section section{"fig6b", "Fig. 6b: tolerated loss"};
    section.add(page::paragraph("Random loss in percent; burst loss as messages lost in a row of "
                                "every 100. The path has no delay of its own."));
    return limits_section(results, std::move(section), {"random-loss", "burst-loss"});
}

} // namespace hapnet::lab::report
