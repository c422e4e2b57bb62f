// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::report {

namespace {

using PointRows = std::vector<results::PointQosRow>;

constexpr std::string_view any_task = "all tasks";

/// Of 100 points, how many an algorithm bears.
double borne_percent(const PointRows& rows, std::string_view algorithm, std::string_view task)
{
    std::map<std::uint32_t, metrics::Tier> worst; // of each point
    for (const auto& [point, cell] : rows) {
        if (cell.algorithm != algorithm || (task != any_task && cell.task != task)) continue;
        const auto [known, is_new] = worst.emplace(point, cell.judged.tier);
        if (!is_new) known->second = std::min(known->second, cell.judged.tier);
    }
    if (worst.empty()) return 0.0;
    const auto borne = std::ranges::count_if(
        worst, [](const auto& one) { return one.second != metrics::Tier::unusable; });
    return 100.0 * static_cast<double>(borne) / static_cast<double>(worst.size());
}

} // namespace

std::optional<Section> points_section(const results::Results& results)
{
    const PointRows& rows = results.qos_by_point;
    if (rows.empty()) return std::nullopt;
    const auto algorithms = distinct(rows, [](const auto& row) { return row.cell.algorithm; });
    auto tasks = distinct(rows, [](const auto& row) { return row.cell.task; });
    const auto points = distinct(rows, [](const auto& row) { return row.point; }).size();
    tasks.emplace_back(any_task);
    page::Bars groups;
    for (const std::string& task : tasks) {
        page::BarGroup group{task, {}};
        for (const std::string& algorithm : algorithms) {
            const double percent = borne_percent(rows, algorithm, task);
            group.bars.push_back({.series = algorithm,
                                  .value = percent,
                                  .text = shown(percent, 0),
                                  .colour = colour_of(algorithm),
                                  .tip = fmt::format("{}, {}", algorithm, task)});
        }
        groups.push_back(std::move(group));
    }
    Section section{"points", "Conditions varied together"};
    section.add(page::paragraph("An algorithm bears a point when it is at least usable there."));
    Json figure = section.keep(
        {.id = "points",
         .title = "Points that are borne",
         .x = {"task"},
         .y = {"points", "%"},
         .content = std::move(groups),
         .size = {560.0, 260.0},
         .caption = fmt::format("Share of {} points that each algorithm bears", points)});
    section.add(page::panels("", Json::array({std::move(figure)})));
    return section;
}

} // namespace hapnet::lab::report
