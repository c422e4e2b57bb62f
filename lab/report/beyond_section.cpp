// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::report {

using plot::escaped;

namespace {

std::string badge_of(results::ClaimVerdict verdict)
{
    const std::string_view style =
        verdict == results::ClaimVerdict::undecided ? "seen" : base::name_of(verdict);
    return fmt::format("<span class='badge {}'>{}</span>", style, base::name_of(verdict));
}

std::string claims_table(const results::Results& results)
{
    HtmlTable table{"Each claim, with its numbers in the seeds that judge and in all",
                    {"claim", "accepted", "worst of the seeds<br>that judge", "nine of ten<br>keep",
                     "seeds", "verdict"}};
    for (const results::ClaimRow& row : results.claims) {
        const auto all = std::ranges::find(results.claims_quantiles, row.claim,
                                           &results::ClaimQuantileRow::claim);
        const bool has_all = all != results.claims_quantiles.end();
        const bool is_missed = row.verdict == results::ClaimVerdict::missed;
        table.rows.push_back({{escaped(row.claim)},
                              {escaped(row.accept), "band"},
                              {escaped(row.value), is_missed ? "ours missed" : "ours"},
                              {has_all ? escaped(all->quantile) : "", "ours"},
                              {has_all ? fmt::format("{}", all->seeds) : ""},
                              {badge_of(row.verdict)}});
    }
    return html_of(table);
}

} // namespace

std::optional<Section> beyond_section(const results::Results& results)
{
    if (results.claims.empty()) return std::nullopt;
    const auto missed = std::ranges::count(results.claims, results::ClaimVerdict::missed,
                                           &results::ClaimRow::verdict);
    return Section{"beyond", "What is claimed beyond the paper",
                   fmt::format("<p>{} claims, made before the first run; {} missed. A claim is met "
                               "when the worst of the seeds that judge keeps all its numbers, or "
                               "their mean where it is of a mean. Hands are simulated.</p>\n",
                               results.claims.size(), missed) +
                       claims_table(results)};
}

} // namespace hapnet::lab::report
