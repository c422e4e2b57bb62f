// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"
#include "proto/plot/heat_map.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::report {

using plot::escaped;

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
std::string plane_map(const std::vector<results::QosRow>& rows, const std::vector<double>& delays,
                      const std::vector<double>& jitters)
{
    std::vector<PlaneCellOnPage> cells(delays.size() * jitters.size());
    for (const results::QosRow& row : rows) {
        const std::size_t column = index_of(delays, row.delay_ms);
        add_task(cells[index_of(jitters, row.jitter_ms) * delays.size() + column], row);
    }
    plot::HeatMap map;
    for (const double delay : delays) map.columns.push_back(plain(delay));
    for (const double jitter : jitters)
        map.rows.push_back((jitter > 0.0 ? "± " : "") + plain(jitter));
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (cells[i].tip.empty()) continue; // not tried
        map.cells.push_back({i % delays.size(), i / delays.size(), tier_colour(cells[i].worst),
                             tier_symbol(cells[i].worst), cells[i].tip});
    }
    const std::string title =
        fmt::format("{}, {} % loss", rows.front().algorithm, plain(rows.front().loss_percent));
    const double height = 90.0 + 34.0 * static_cast<double>(jitters.size());
    return plot::svg_heat_map({title, "delay, ms", "jitter, ms"}, map, {280.0, height});
}

std::string legend()
{
    std::string out = "<p class='legend'>";
    for (const metrics::Tier tier :
         {metrics::Tier::good, metrics::Tier::usable, metrics::Tier::unusable}) {
        out += tier_badge(tier) + " ";
    }
    return out + "worst of the tasks; point at a field for its numbers</p>\n";
}

} // namespace

std::optional<Section> qos_section(const results::Results& results)
{
    if (results.qos.empty()) return std::nullopt;
    Section section{"qos", "What a network must offer",
                    "<p>The whole plane of delay and jitter, once for each loss.</p>\n" + legend()};
    section.sources = links_to(results, "qos.csv");
    const auto delays = ascending(results.qos, &results::QosRow::delay_ms);
    const auto jitters = ascending(results.qos, &results::QosRow::jitter_ms);
    const auto losses = ascending(results.qos, &results::QosRow::loss_percent);
    for (const auto& name : distinct(results.qos, [](const auto& row) { return row.algorithm; })) {
        section.html += fmt::format("<h3>{}</h3>\n<div class='panels tiny'>\n", escaped(name));
        for (const double loss : losses) {
            std::vector<results::QosRow> rows;
            for (const results::QosRow& row : results.qos) {
                if (row.algorithm == name && row.loss_percent == loss) rows.push_back(row);
            }
            if (rows.empty()) continue;
            section.add_figure(fmt::format("qos-{}-{}", name, plain(loss)),
                               plane_map(rows, delays, jitters),
                               fmt::format("{}, {} % loss", escaped(name), plain(loss)));
        }
        section.html += "</div>\n";
    }
    return section;
}

} // namespace hapnet::lab::report
