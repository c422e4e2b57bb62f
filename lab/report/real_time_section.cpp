// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"

#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::report {

namespace {

constexpr double agreement_percent = 5.0; // of mean and std, for a run that is valid

std::optional<double> difference_percent(std::optional<double> real,
                                         std::optional<double> simulated)
{
    if (!real || !simulated || *simulated == 0.0) return std::nullopt;
    return 100.0 * (*real - *simulated) / *simulated;
}

/// How far real time is from virtual time; red when that is too far and the run is valid.
page::Cell difference_cell(const results::RealTimeRow& row, std::optional<double> real,
                           std::optional<double> simulated)
{
    const auto percent = difference_percent(real, simulated);
    if (!percent || !row.is_valid) return {"–"};
    const bool is_far = std::abs(*percent) > agreement_percent;
    return {fmt::format("{:+.1f} %", *percent), is_far ? "ours missed" : "ours"};
}

Json times_table(const std::vector<results::RealTimeRow>& rows)
{
    page::Table table{"Real time over UDP beside virtual time, mm",
                      {"algorithm", "where", "mean\nreal", "mean\nvirtual", "differs", "std\nreal",
                       "std\nvirtual", "differs", "max\nreal", "max\nvirtual", "valid"}};
    for (const results::RealTimeRow& row : rows) {
        const std::string style = row.is_valid ? "" : "excluded";
        table.rows.push_back(
            {{row.algorithm},
             {row.where, "name"},
             {shown(row.mean_mm, 2), style},
             {shown(row.virtual_mean_mm, 2)},
             difference_cell(row, row.mean_mm, row.virtual_mean_mm),
             {shown(row.std_mm, 2), style},
             {shown(row.virtual_std_mm, 2)},
             difference_cell(row, row.std_mm, row.virtual_std_mm),
             {shown(row.max_mm, 2), style},
             {shown(row.virtual_max_mm, 2)},
             {row.is_valid ? "valid" : "excluded: " + row.invalid_because, "words"}});
    }
    return json_of(table);
}

std::optional<page::Figure> times_bars(const std::vector<results::RealTimeRow>& rows)
{
    page::Bars groups;
    for (const results::RealTimeRow& row : rows) {
        if (!row.is_valid || !row.mean_mm || !row.virtual_mean_mm) continue;
        const auto colour = colour_of(row.algorithm);
        groups.push_back({fmt::format("{}, {}", row.algorithm, row.where),
                          {{.series = "virtual time",
                            .value = *row.virtual_mean_mm,
                            .text = shown(row.virtual_mean_mm, 2),
                            .colour = colour,
                            .is_outlined = true,
                            .tip = "virtual time"},
                           {.series = "real time",
                            .value = *row.mean_mm,
                            .text = shown(row.mean_mm, 2),
                            .colour = colour,
                            .tip = "real time"}}});
    }
    if (groups.empty()) return std::nullopt;
    return page::Figure{.id = "real-time",
                        .title = "Mean discrepancy",
                        .x = {"left: virtual time, right: real time"},
                        .y = {"discrepancy", "mm"},
                        .content = std::move(groups),
                        .size = {900.0, 250.0},
                        .caption = "Dashed: virtual time. Filled: real time."};
}

} // namespace

std::optional<Section> real_time_section(const results::Results& results)
{
    if (results.real_time.empty()) return std::nullopt;
    Section section{"real-time", "Real time beside virtual time"};
    section.add(page::paragraph(
        "The same sessions with the programs themselves, over real UDP. A run whose own timing was "
        "off says more about the machine than about Hapnet: it is named and left out."));
    section.add(times_table(results.real_time));
    section.sources = files_named(results, "real_time.csv");
    if (auto bars = times_bars(results.real_time)) section.add(*std::move(bars));
    return section;
}

} // namespace hapnet::lab::report
