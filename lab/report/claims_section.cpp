// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"
#include "proto/plot/axis.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::report {

using plot::escaped;

namespace {

void add_claim(Claims& claims, results::Claim claim, std::string line)
{
    switch (claim) {
    case results::Claim::none: break;
    case results::Claim::calibrated: claims.calibrated.push_back(std::move(line)); break;
    case results::Claim::met: claims.met.push_back(std::move(line)); break;
    case results::Claim::missed: claims.missed.push_back(std::move(line)); break;
    }
}

std::string line_of(const results::Table1Row& row)
{
    return fmt::format("Table 1, <b>{}</b>: mean {}, std {}, max {} mm (paper: {}, {}, {})",
                       escaped(row.algorithm), shown(row.mean_mm, 2), shown(row.std_mm, 2),
                       shown(row.max_mm, 1), shown(row.paper_mean_mm, 2),
                       shown(row.paper_std_mm, 2), shown(row.paper_max_mm, 1));
}

std::string line_of(const results::LimitRow& row)
{
    const auto paper = row.paper_limit ? limit_text(*row.paper_limit, false, row.unit) : "–";
    return fmt::format("Limit of {}, <b>{}</b>, {}: {} (paper: {})",
                       escaped(impairment_text(row.impairment)), escaped(row.algorithm),
                       row.task == results::worst_task ? "worst of the tasks"
                                                       : "in " + escaped(row.task),
                       escaped(limit_text(row.limit, row.is_open(), row.unit)), escaped(paper));
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
           list("Predicted and met", "met", claims.met) +
           list("Predicted and missed", "missed", claims.missed) + "</div>\n";
}

bool is_empty(const Claims& claims)
{
    return claims.calibrated.empty() && claims.met.empty() && claims.missed.empty();
}

} // namespace

Claims main_claims(const results::Results& results)
{
    Claims claims;
    for (const results::Table1Row& row : results.table1)
        add_claim(claims, row.verdict, line_of(row));
    for (const results::LimitRow& row : results.limits) {
        if (row.task == results::worst_task) add_claim(claims, to_claim(row.status), line_of(row));
    }
    return claims;
}

Claims task_claims(const results::Results& results)
{
    Claims claims;
    for (const results::LimitRow& row : results.limits) {
        if (row.task != results::worst_task) add_claim(claims, to_claim(row.status), line_of(row));
    }
    return claims;
}

std::optional<Section> claims_section(const results::Results& results)
{
    const Claims main = main_claims(results), of_tasks = task_claims(results);
    if (is_empty(main) && is_empty(of_tasks)) return std::nullopt;
    Section section{"claims", "Calibrated, predicted, missed",
                    "<p>What was calibrated was fitted to the paper and so shows nothing by "
                    "agreeing. What was predicted came out of the same settings untouched.</p>\n" +
                        lists(main)};
    if (!is_empty(of_tasks)) {
        section.html += folded("The same for single tasks", lists(of_tasks));
    }
    return section;
}

} // namespace hapnet::lab::report
