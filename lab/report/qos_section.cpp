// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::report {

namespace {

std::vector<double> ascending(const std::vector<results::QosRow>& rows,
                              double results::QosRow::*value)
{
    auto values = distinct(rows, [&](const results::QosRow& row) { return row.*value; });
    std::sort(values.begin(), values.end());
    return values;
}

std::size_t index_of(const std::vector<double>& values, double value)
{
    return static_cast<std::size_t>(std::find(values.begin(), values.end(), value) -
                                    values.begin());
}

/// A cell of the plane: the worst of the tasks, and what each says.
struct PlaneCellOnPage {
    metrics::Tier worst = metrics::Tier::good;
    std::string tip;
};

void add_task(PlaneCellOnPage& cell, const results::QosRow& row)
{
    cell.worst = std::min(cell.worst, row.judged.tier);
    if (cell.tip.empty()) {
        cell.tip = fmt::format("{} ms, ± {} ms, {} %", plain(row.delay_ms), plain(row.jitter_ms),
                               plain(row.loss_percent));
    }
    cell.tip +=
        fmt::format("\n{}: {}, vibration {} mm, stiffness {}, force vibration {} N", row.task,
                    to_text(row.judged.tier), shown(row.judged.vibration_mm, 3),
                    shown(row.judged.stiffness_ratio, 2), shown(row.judged.force_vibration_n, 3));
    if (row.judged.turned_apart_deg)
        cell.tip +=
            fmt::format(", copies turned apart {} deg", shown(row.judged.turned_apart_deg, 2));
}

/// One algorithm at one loss.
page::Figure plane_map(const std::vector<results::QosRow>& rows, const std::vector<double>& delays,
                       const std::vector<double>& jitters)
{
    std::vector<PlaneCellOnPage> cells(delays.size() * jitters.size());
    for (const results::QosRow& row : rows) {
        const std::size_t column = index_of(delays, row.delay_ms);
        add_task(cells[index_of(jitters, row.jitter_ms) * delays.size() + column], row);
    }
    page::HeatMap map;
    for (const double delay : delays) map.columns.push_back(plain(delay));
    for (const double jitter : jitters)
        map.rows.push_back((jitter > 0.0 ? "± " : "") + plain(jitter));
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (cells[i].tip.empty()) continue; // not tried
        map.cells.push_back({.column = i % delays.size(),
                             .row = i / delays.size(),
                             .colour = tier_colour(cells[i].worst),
                             .symbol = tier_symbol(cells[i].worst),
                             .tip = cells[i].tip});
    }
    const std::string& algorithm = rows.front().algorithm;
    const std::string loss = plain(rows.front().loss_percent);
    const std::string title = fmt::format("{}, {} % loss", algorithm, loss);
    return {.id = page::plain_id(fmt::format("qos-{}-{}", algorithm, loss)),
            .title = title,
            .x = {"delay", "ms"},
            .y = {"jitter", "ms"},
            .content = std::move(map),
            .size = {280.0, 90.0 + 34.0 * static_cast<double>(jitters.size())},
            .caption = title};
}

Json legend()
{
    Json text = Json::array();
    for (const metrics::Tier tier :
         {metrics::Tier::good, metrics::Tier::usable, metrics::Tier::unusable}) {
        text.push_back(tier_badge(tier));
        text.push_back(" ");
    }
    text.push_back("worst of the tasks; point at a field for its numbers");
    return page::paragraph(std::move(text));
}

} // namespace

std::optional<Section> qos_section(const results::Results& results)
{
    if (results.qos.empty()) return std::nullopt;
    Section section{"qos", "What a network must offer"};
    section.add(page::paragraph("The whole plane of delay and jitter, once for each loss."));
    section.add(legend());
    section.sources = files_named(results, "qos.csv");
    const auto delays = ascending(results.qos, &results::QosRow::delay_ms);
    const auto jitters = ascending(results.qos, &results::QosRow::jitter_ms);
    const auto losses = ascending(results.qos, &results::QosRow::loss_percent);
    for (const auto& name : distinct(results.qos, [](const auto& row) { return row.algorithm; })) {
        section.add(page::heading(name));
        Json maps = Json::array();
        for (const double loss : losses) {
            const auto rows = rows_where(results.qos, [&](const results::QosRow& row) {
                return row.algorithm == name && row.loss_percent == loss;
            });
            if (rows.empty()) continue;
            maps.push_back(section.keep(plane_map(rows, delays, jitters)));
        }
        section.add(page::panels("tiny", std::move(maps)));
    }
    return section;
}

} // namespace hapnet::lab::report
