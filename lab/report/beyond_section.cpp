// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/paired.hpp"
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hapnet::lab::report {

namespace {

Json badge_of(results::ClaimVerdict verdict)
{
    const std::string_view style =
        verdict == results::ClaimVerdict::undecided ? "seen" : base::name_of(verdict);
    return page::badge(base::name_of(verdict), style);
}

Json claims_table(const results::Results& results)
{
    page::Table table{"Each claim, with its numbers in the seeds that judge and in all",
                      {"claim", "accepted", "worst of the seeds\nthat judge", "nine of ten\nkeep",
                       "seeds", "verdict"}};
    for (const results::ClaimRow& row : results.claims) {
        const auto all = std::ranges::find(results.claims_quantiles, row.claim,
                                           &results::ClaimQuantileRow::claim);
        const bool has_all = all != results.claims_quantiles.end();
        const bool is_missed = row.verdict == results::ClaimVerdict::missed;
        table.rows.push_back({{row.claim},
                              {row.accept, "band"},
                              {row.value, is_missed ? "ours missed" : "ours"},
                              {has_all ? all->quantile : "", "ours"},
                              {has_all ? fmt::format("{}", all->seeds) : ""},
                              {badge_of(row.verdict)}});
    }
    return json_of(table);
}

/// Median and largest of the seeds; empty: not played so, or not measured.
std::string above_2hz(const results::Results& results, std::string_view condition,
                      std::string_view task)
{
    std::vector<double> values;
    for (const results::ClaimSessionRow& row : results.claim_sessions) {
        const bool is_first = row.algorithm == results.claim_sessions.front().algorithm;
        if (is_first && row.condition == condition && row.task == task && row.force_above_2hz_n)
            values.push_back(*row.force_above_2hz_n);
    }
    if (values.empty()) return "";
    const double largest = *std::ranges::max_element(values);
    return fmt::format("{} ({})", shown(metrics::median_of(std::move(values)), 3),
                       shown(largest, 3));
}

/// What no claim is about, and no verdict sees: how hard the copies pull at each other slowly.
void add_tug_of_war(Section& section, const results::Results& results)
{
    const auto& rows = results.claim_sessions;
    page::Table table{"Force above 2 Hz that the network adds, N: median of the seeds (largest)",
                      {"conditions"}};
    const auto tasks = distinct(rows, [](const auto& row) { return row.task; });
    for (const std::string& task : tasks) table.heads.push_back(task);
    bool is_empty = true;
    for (const auto& condition : distinct(rows, [](const auto& row) { return row.condition; })) {
        auto& cells = table.rows.emplace_back();
        cells.push_back({condition});
        for (const std::string& task : tasks) {
            cells.push_back({above_2hz(results, condition, task)});
            is_empty = is_empty && cells.back().text.empty();
        }
    }
    if (is_empty) return;
    section.add(page::paragraph("No claim is about this number, and “usable” does not see it: two "
                                "copies that pull at each other a few times a second."));
    section.add(json_of(table));
}

} // namespace

std::optional<Section> beyond_section(const results::Results& results)
{
    if (results.claims.empty()) return std::nullopt;
    const auto missed = std::ranges::count(results.claims, results::ClaimVerdict::missed,
                                           &results::ClaimRow::verdict);
    Section section{"beyond", "What is claimed beyond the paper"};
    section.add(page::paragraph(fmt::format(
        "{} claims, made before the first run; {} missed. A claim is met when the worst of the "
        "seeds that judge keeps all its numbers, or their mean where it is of a mean. Hands are "
        "simulated.",
        results.claims.size(), missed)));
    section.add(claims_table(results));
    add_tug_of_war(section, results);
    return section;
}

} // namespace hapnet::lab::report
