// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::report {

namespace {

using AxisRows = std::vector<results::AxisLimitRow>;

/// "both.delay" of people: what the built-in experiments vary.
std::string parameter_text(const std::string& parameter)
{
    if (parameter == "both.delay") return "delay of the path";
    if (parameter == "jitter_order") return "order of jittered messages";
    if (parameter == "algorithm.dead-reckoning.velocity") return "velocity of dead reckoning";
    if (parameter == "algorithm.dead-reckoning.horizon") return "horizon of dead reckoning";
    return parameter;
}

/// The worst of the tasks, one group for each value, with intervals.
page::Figure axis_bars(const AxisRows& rows)
{
    page::Bars groups;
    for (const auto& value : distinct(rows, [](const auto& row) { return row.value; })) {
        page::BarGroup group{value, {}};
        for (const results::AxisLimitRow& row : rows) {
            const results::LimitRow& limit = row.limit;
            if (row.value != value || limit.task != results::worst_task) continue;
            group.bars.push_back(
                limit_bar(limit, limit.algorithm, fmt::format("{}, {}", limit.algorithm, value)));
        }
        groups.push_back(std::move(group));
    }
    const results::LimitRow& first = rows.front().limit;
    const std::string across = parameter_text(rows.front().parameter);
    const std::string impairment = impairment_text(first.impairment);
    return {
        .id = page::plain_id(fmt::format("axis-{}-{}", rows.front().parameter, first.impairment)),
        .title = fmt::format("Limit of {}", impairment),
        .x = {across},
        .y = {"limit", std::string{unit_text(first.unit)}},
        .content = std::move(groups),
        .size = {440.0, 260.0},
        .caption = fmt::format("Limit of {} by the {}, {} seeds", impairment, across, first.seeds)};
}

} // namespace

std::optional<Section> axis_section(const results::Results& results)
{
    if (results.limits_by_axis.empty()) return std::nullopt;
    Section section{"axis", "What was not chosen, and what the paper leaves open"};
    section.add(page::paragraph(
        "The limits again, for other readings of the paper and other conditions that it does not "
        "state. The worst of the tasks; lines are 95 % intervals."));
    section.sources = files_named(results, "limits_by_axis.csv");
    const auto kinds = distinct(results.limits_by_axis, [](const results::AxisLimitRow& row) {
        return std::pair{row.parameter, row.limit.impairment};
    });
    Json figures = Json::array();
    for (const auto& [parameter, impairment] : kinds) {
        const auto is_of = [p = parameter, i = impairment](const results::AxisLimitRow& row) {
            return row.parameter == p && row.limit.impairment == i;
        };
        const AxisRows rows = rows_where(results.limits_by_axis, is_of);
        figures.push_back(section.keep(axis_bars(rows)));
    }
    section.add(page::panels("", std::move(figures)));
    return section;
}

std::optional<Section> paired_section(const results::Results& results)
{
    if (results.paired.empty()) return std::nullopt;
    page::Table table{
        "Algorithms that met the same hands and the same network, seed by seed: their "
        "difference, its 95 % interval by resampling the seeds, and the sign test",
        {"algorithm", "minus", "task", "of", "seeds", "difference", "95 %", "p"}};
    for (const results::PairedRow& row : results.paired) {
        const auto end = [](std::optional<double> value) { return shown(value, 3); };
        const bool is_known = row.ci_low || row.ci_high;
        table.rows.push_back(
            {{row.algorithm},
             {row.reference, "name"},
             {row.task, "name"},
             {row.measure, "words"},
             {std::to_string(row.seeds)},
             {end(row.difference)},
             {is_known ? fmt::format("{} … {}", end(row.ci_low), end(row.ci_high)) : "–"},
             {row.sign_test_p ? fmt::format("{:.2g}", *row.sign_test_p) : "–"}});
    }
    Section section{"paired", "Algorithms seed by seed"};
    section.add(page::paragraph("The p of a row is for that row alone: of a hundred rows without "
                                "any difference five have p below 0.05."));
    section.add(page::folded("The table", Json::array({json_of(table)})));
    return section;
}

} // namespace hapnet::lab::report
