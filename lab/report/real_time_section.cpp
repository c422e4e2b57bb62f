// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"
#include "proto/plot/bars.hpp"

#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::report {

using plot::escaped;

namespace {

constexpr double agreement_percent = 5.0; // of mean and std, for a run that is valid

std::optional<double> difference_percent(std::optional<double> real,
                                         std::optional<double> simulated)
{
    if (!real || !simulated || *simulated == 0.0) return std::nullopt;
    return 100.0 * (*real - *simulated) / *simulated;
}

/// How far real time is from virtual time; red when that is too far and the run is valid.
HtmlCell difference_cell(const results::RealTimeRow& row, std::optional<double> real,
                         std::optional<double> simulated)
{
    const auto percent = difference_percent(real, simulated);
    if (!percent || !row.is_valid) return {"–"};
    const bool is_far = std::abs(*percent) > agreement_percent;
    return {fmt::format("{:+.1f} %", *percent), is_far ? "ours missed" : "ours"};
}

std::string times_table(const std::vector<results::RealTimeRow>& rows)
{
    HtmlTable table{"Real time over UDP beside virtual time, mm",
                    {"algorithm", "where", "mean<br>real", "mean<br>virtual", "differs",
                     "std<br>real", "std<br>virtual", "differs", "max<br>real", "max<br>virtual",
                     "valid"}};
    for (const results::RealTimeRow& row : rows) {
        const std::string_view style = row.is_valid ? "" : "excluded";
        table.rows.push_back(
            {{escaped(row.algorithm)},
             {escaped(row.where), "name"},
             {shown(row.mean_mm, 2), style},
             {shown(row.virtual_mean_mm, 2)},
             difference_cell(row, row.mean_mm, row.virtual_mean_mm),
             {shown(row.std_mm, 2), style},
             {shown(row.virtual_std_mm, 2)},
             difference_cell(row, row.std_mm, row.virtual_std_mm),
             {shown(row.max_mm, 2), style},
             {shown(row.virtual_max_mm, 2)},
             {row.is_valid ? "valid" : "excluded: " + escaped(row.invalid_because), "words"}});
    }
    return html_of(table);
}

Drawing times_bars(const std::vector<results::RealTimeRow>& rows)
{
    std::vector<plot::BarGroup> groups;
    for (const results::RealTimeRow& row : rows) {
        if (!row.is_valid || !row.mean_mm || !row.virtual_mean_mm) continue;
        const auto colour = colour_of(row.algorithm);
        groups.push_back({fmt::format("{}, {}", row.algorithm, row.where),
                          {{.value = *row.virtual_mean_mm,
                            .label = shown(row.virtual_mean_mm, 2),
                            .colour = colour,
                            .is_outlined = true,
                            .tip = "virtual time"},
                           {.value = *row.mean_mm,
                            .label = shown(row.mean_mm, 2),
                            .colour = colour,
                            .tip = "real time"}}});
    }
    if (groups.empty()) return {};
    return drawn_bars({"Mean discrepancy", "left: virtual time, right: real time", "mm"}, groups,
                      {}, {900.0, 250.0});
}

} // namespace

std::optional<Section> real_time_section(const results::Results& results)
{
    if (results.real_time.empty()) return std::nullopt;
    Section section{"real-time", "Real time beside virtual time",
                    "<p>The same sessions with the programs themselves, over real UDP. A run whose "
                    "own timing was off says more about the machine than about Hapnet: it is named "
                    "and left out.</p>\n" +
                        times_table(results.real_time)};
    section.sources = links_to(results, "real_time.csv");
    auto bars = times_bars(results.real_time);
    if (!bars.svg.empty()) {
        section.add_figure("real-time", std::move(bars),
                           "Dashed: virtual time. Filled: real time.");
    }
    return section;
}

} // namespace hapnet::lab::report
