// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::report {

namespace {

/// Green is for predictions alone.
void add_claim(Claims& claims, results::Provenance provenance, results::Claim claim, Json line)
{
    switch (claim) {
    case results::Claim::none: return;
    case results::Claim::missed: return claims.missed.push_back(std::move(line));
    case results::Claim::undecided: return claims.undecided.push_back(std::move(line));
    case results::Claim::calibrated:
    case results::Claim::met: break;
    }
    switch (provenance) {
    case results::Provenance::none: break;
    case results::Provenance::calibrated: return claims.calibrated.push_back(std::move(line));
    case results::Provenance::selected: return claims.selected.push_back(std::move(line));
    case results::Provenance::by_construction:
        return claims.by_construction.push_back(std::move(line));
    case results::Provenance::predicted: break;
    }
    claims.met.push_back(std::move(line));
}

std::string class_of(results::Provenance provenance)
{
    return fmt::format(", {}", base::name_of(provenance));
}

Json line_of(const results::Table1Row& row)
{
    return page::text_of(
        {"Table 1, ", page::bold(row.algorithm),
         fmt::format(": mean {}, std {}, max {} mm (paper: {}, {}, {})", shown(row.mean_mm, 2),
                     shown(row.std_mm, 2), shown(row.max_mm, 1), shown(row.paper_mean_mm, 2),
                     shown(row.paper_std_mm, 2), shown(row.paper_max_mm, 1)) +
             class_of(row.provenance)});
}

std::string interval_of(const results::LimitRow& row)
{
    if (!row.ci_low || !row.ci_high) return "";
    return fmt::format(", 95 %: {} … {}", shown(row.ci_low, 1), shown(row.ci_high, 1));
}

Json line_of(const results::LimitRow& row)
{
    const auto paper = row.paper_limit ? limit_text(*row.paper_limit, false, row.unit) : "–";
    return page::text_of(
        {fmt::format("Limit of {}, ", impairment_text(row.impairment)), page::bold(row.algorithm),
         fmt::format(", {}: {} (paper: {})",
                     row.task == results::worst_task ? "worst of the tasks" : "in " + row.task,
                     limit_text(row.limit, row.is_open(), row.unit), paper) +
             interval_of(row) + class_of(row.provenance)});
}

Json list(std::string_view title, std::string_view style, const std::vector<Json>& lines)
{
    Json list = Json::object({{"title", title}, {"style", style}});
    list["list"] = lines;
    return list;
}

Json lists(const Claims& claims)
{
    Json block = Json::object();
    block["claims"] = Json::array({list("Calibrated", "calibrated", claims.calibrated),
                                   list("Selected, and agrees", "seen", claims.selected),
                                   list("The same by construction", "seen", claims.by_construction),
                                   list("Predicted and met", "met", claims.met),
                                   list("Undecided", "seen", claims.undecided),
                                   list("Missed", "missed", claims.missed)});
    return block;
}

} // namespace

bool Claims::are_none() const
{
    return calibrated.empty() && selected.empty() && by_construction.empty() && met.empty() &&
           undecided.empty() && missed.empty();
}

Claims main_claims(const results::Results& results)
{
    Claims claims;
    for (const results::Table1Row& row : results.table1)
        add_claim(claims, row.provenance, row.verdict, line_of(row));
    for (const results::LimitRow& row : results.limits) {
        if (row.task == results::worst_task)
            add_claim(claims, row.provenance, to_claim(row.status), line_of(row));
    }
    return claims;
}

std::optional<Section> claims_section(const results::Results& results)
{
    const Claims claims = main_claims(results);
    if (claims.are_none()) return std::nullopt;
    constexpr auto selected =
        ": it follows from a reading of the paper that was chosen among several with a look at "
        "this very number. ";
    constexpr auto undecided =
        ": the 95 % interval lies across the edge of what would agree. The paper’s numbers are of "
        "all tasks together, so single tasks are not held against them.";
    Section section{"claims", "What stands against the paper, and how it came about"};
    section.add(page::paragraph(page::text_of(
        {page::bold("Calibrated"), ": fitted to the paper’s number, so agreeing shows nothing. ",
         page::bold("Selected"), selected, page::bold("By construction"), ": sep is base there. ",
         page::bold("Predicted"), ": the number had no part in any choice. ",
         page::bold("Undecided"), undecided})));
    section.add(lists(claims));
    return section;
}

} // namespace hapnet::lab::report
