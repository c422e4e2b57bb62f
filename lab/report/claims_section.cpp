// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"
#include "proto/plot/axis.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::report {

using plot::escaped;

namespace {

/// Green is for predictions alone.
void add_claim(Claims& claims, results::Provenance provenance, results::Claim claim,
               std::string line)
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

std::string line_of(const results::Table1Row& row)
{
    return fmt::format("Table 1, <b>{}</b>: mean {}, std {}, max {} mm (paper: {}, {}, {})",
                       escaped(row.algorithm), shown(row.mean_mm, 2), shown(row.std_mm, 2),
                       shown(row.max_mm, 1), shown(row.paper_mean_mm, 2),
                       shown(row.paper_std_mm, 2), shown(row.paper_max_mm, 1)) +
           class_of(row.provenance);
}

std::string interval_of(const results::LimitRow& row)
{
    if (!row.ci_low || !row.ci_high) return "";
    return fmt::format(", 95 %: {} … {}", shown(row.ci_low, 1), shown(row.ci_high, 1));
}

std::string line_of(const results::LimitRow& row)
{
    const auto paper = row.paper_limit ? limit_text(*row.paper_limit, false, row.unit) : "–";
    return fmt::format("Limit of {}, <b>{}</b>, {}: {} (paper: {})",
                       escaped(impairment_text(row.impairment)), escaped(row.algorithm),
                       row.task == results::worst_task ? "worst of the tasks"
                                                       : "in " + escaped(row.task),
                       escaped(limit_text(row.limit, row.is_open(), row.unit)), escaped(paper)) +
           interval_of(row) + class_of(row.provenance);
}

std::string list(std::string_view title, std::string_view style,
                 const std::vector<std::string>& lines)
{
    std::string out =
        fmt::format("<div class='claims {}'><h3>{} ({})</h3>\n<ul>\n", style, title, lines.size());
    for (const std::string& line : lines) out += "<li>" + line + "</li>\n";
    if (lines.empty()) out += "<li class='none'>nothing</li>\n";
    return out + "</ul></div>\n";
}

std::string lists(const Claims& claims)
{
    return "<div class='three'>\n" + list("Calibrated", "calibrated", claims.calibrated) +
           list("Selected, and agrees", "seen", claims.selected) +
           list("The same by construction", "seen", claims.by_construction) +
           list("Predicted and met", "met", claims.met) +
           list("Undecided", "seen", claims.undecided) + list("Missed", "missed", claims.missed) +
           "</div>\n";
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
    return Section{
        "claims", "What stands against the paper, and how it came about",
        "<p><b>Calibrated</b>: fitted to the paper’s number, so agreeing shows nothing. "
        "<b>Selected</b>: it follows from a reading of the paper that was chosen among several "
        "with a look at this very number. <b>By construction</b>: sep is base there. "
        "<b>Predicted</b>: the number had no part in any choice. <b>Undecided</b>: the 95 % "
        "interval lies across the edge of what would agree. The paper’s numbers are of all tasks "
        "together, so single tasks are not held against them.</p>\n" +
            lists(claims)};
}

} // namespace hapnet::lab::report
