// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/words.hpp"

#include "proto/plot/axis.hpp"

#include <array>
#include <cmath>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::report {

using plot::escaped;

namespace {

using Pair = std::pair<std::string_view, std::string_view>;

template <std::size_t count>
std::string_view found_in(const std::array<Pair, count>& pairs, std::string_view key,
                          std::string_view otherwise)
{
    for (const auto& [name, value] : pairs) {
        if (name == key) return value;
    }
    return otherwise;
}

} // namespace

std::string shown(std::optional<double> value, int decimals)
{
    if (!value) return "–";
    // No "-0.00": what is nothing at that many decimals has no sign.
    const bool is_nothing = std::abs(*value) < 0.5 * std::pow(10.0, -decimals);
    return fmt::format("{:.{}f}", is_nothing ? 0.0 : *value, decimals);
}

std::string plain(double value) { return fmt::format("{:g}", value); }

std::string limit_text(double limit, bool is_open, std::string_view unit)
{
    return fmt::format("{}{} {}", is_open ? "> " : "", plain(limit), unit_text(unit));
}

std::string_view unit_text(std::string_view unit)
{
    constexpr std::array<Pair, 2> known{{{"percent", "%"}, {"of_100", "of 100"}}};
    return found_in(known, unit, unit);
}

std::string impairment_text(std::string_view impairment)
{
    constexpr std::array<Pair, 2> known{
        {{"random-loss", "random loss"}, {"burst-loss", "burst loss"}}};
    return std::string{found_in(known, impairment, impairment)};
}

std::string_view claim_text(results::Claim claim) { return base::name_of(claim); }

std::string claim_badge(results::Claim claim)
{
    if (claim == results::Claim::none) return "";
    return fmt::format("<span class='badge {0}'>{0}</span>", claim_text(claim));
}

std::string class_badge(results::Provenance provenance)
{
    if (provenance == results::Provenance::none) return "";
    return fmt::format("<span class='badge'>{}</span>", base::name_of(provenance));
}

std::string status_badge(results::LimitStatus status)
{
    if (status == results::LimitStatus::none) return "";
    // Green is for predictions alone: the rest could hardly have come out otherwise.
    std::string_view style = claim_text(to_claim(status));
    if (style == "met" && status != results::LimitStatus::predicted_met) style = "seen";
    return fmt::format("<span class='badge {}'>{}</span>", style, base::name_of(status));
}

std::string_view tier_symbol(metrics::Tier tier)
{
    switch (tier) {
    case metrics::Tier::unusable: return "×";
    case metrics::Tier::usable: return "○";
    case metrics::Tier::good: return "●";
    }
    return "";
}

std::string tier_badge(metrics::Tier tier)
{
    return fmt::format("<span class='badge tier-{0}'>{1} {0}</span>", to_text(tier),
                       tier_symbol(tier));
}

std::string_view tier_colour(metrics::Tier tier)
{
    switch (tier) {
    case metrics::Tier::unusable: return "var(--unusable)";
    case metrics::Tier::usable: return "var(--usable)";
    case metrics::Tier::good: return "var(--good)";
    }
    return "";
}

std::string_view colour_of(std::string_view algorithm)
{
    constexpr std::array<Pair, 3> known{{{"base", "var(--base)"},
                                         {"sep", "var(--sep)"},
                                         {"dead-reckoning", "var(--dead-reckoning)"}}};
    return found_in(known, algorithm, "var(--other)");
}

double curve_width(std::string_view algorithm) { return algorithm == "sep" ? 4.0 : 1.2; }

std::string html_of(const HtmlTable& table)
{
    std::string out = fmt::format("<div class='scroll' role='region' tabindex='0' "
                                  "aria-label='{0}'><table><caption>{0}</caption>\n<thead><tr>",
                                  escaped(table.caption));
    for (const std::string& head : table.heads) out += "<th scope='col'>" + head + "</th>";
    out += "</tr></thead>\n<tbody>\n";
    for (const auto& row : table.rows) {
        out += "<tr>";
        for (const HtmlCell& cell : row) {
            const std::string_view tag = &cell == row.data() ? "th scope='row'" : "td";
            const std::string style =
                cell.style.empty() ? "" : fmt::format(" class='{}'", cell.style);
            out += fmt::format("<{}{}>{}</{}>", tag, style, cell.html, tag.substr(0, 2));
        }
        out += "</tr>\n";
    }
    return out + "</tbody></table></div>\n";
}

std::string html_of(const records::TextTable& table)
{
    HtmlTable html{table.caption, {escaped(table.unit)}};
    for (const std::string& head : table.heads) html.heads.push_back(escaped(head));
    const auto has_note = [](const records::TextTable::Row& row) { return !row.note.empty(); };
    const bool has_notes = std::any_of(table.rows.begin(), table.rows.end(), has_note);
    if (has_notes) html.heads.emplace_back();
    for (const records::TextTable::Row& row : table.rows) {
        std::vector<HtmlCell> cells{{escaped(row.name)}};
        for (const std::string& cell : row.cells) cells.push_back({escaped(cell)});
        cells.resize(table.heads.size() + 1);
        if (has_notes) cells.push_back({escaped(row.note), "words"});
        html.rows.push_back(std::move(cells));
    }
    std::string out = html_of(html);
    for (const std::string& remark : table.remarks) out += "<p>" + escaped(remark) + "</p>\n";
    return out;
}

std::string figure(std::string_view svg, std::string_view caption)
{
    return fmt::format("<figure>\n{}<figcaption>{}</figcaption></figure>\n", svg, caption);
}

std::string folded(std::string_view summary, std::string_view html)
{
    return fmt::format("<details><summary>{}</summary>\n{}</details>\n", summary, html);
}

} // namespace hapnet::lab::report
