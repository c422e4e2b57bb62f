// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/words.hpp"

#include <array>
#include <cmath>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::report {

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

page::Json claim_badge(results::Claim claim)
{
    if (claim == results::Claim::none) return "";
    return page::badge(claim_text(claim), claim_text(claim));
}

page::Json class_badge(results::Provenance provenance)
{
    if (provenance == results::Provenance::none) return "";
    return page::badge(base::name_of(provenance));
}

page::Json status_badge(results::LimitStatus status)
{
    if (status == results::LimitStatus::none) return "";
    // Green is for predictions alone: the rest could hardly have come out otherwise.
    std::string_view style = claim_text(to_claim(status));
    if (style == "met" && status != results::LimitStatus::predicted_met) style = "seen";
    return page::badge(base::name_of(status), style);
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

page::Json tier_badge(metrics::Tier tier)
{
    return page::badge(fmt::format("{} {}", tier_symbol(tier), to_text(tier)),
                       fmt::format("tier-{}", to_text(tier)));
}

std::string_view tier_colour(metrics::Tier tier)
{
    switch (tier) {
    case metrics::Tier::unusable: return "unusable";
    case metrics::Tier::usable: return "usable";
    case metrics::Tier::good: return "good";
    }
    return "";
}

std::string_view colour_of(std::string_view algorithm)
{
    constexpr std::array<Pair, 3> known{
        {{"base", "base"}, {"sep", "sep"}, {"dead-reckoning", "dead-reckoning"}}};
    return found_in(known, algorithm, "other");
}

double curve_width(std::string_view algorithm) { return algorithm == "sep" ? 4.0 : 1.2; }

std::string rounded_limit(double limit) { return shown(limit, limit < 20.0 ? 1 : 0); }

page::Bar limit_bar(const results::LimitRow& row, std::string series, std::string tip)
{
    page::Bar bar{.series = std::move(series),
                  .value = row.limit,
                  .text = (row.is_open() ? "> " : "") + rounded_limit(row.limit),
                  .colour = colour_of(row.algorithm),
                  .is_open = row.is_open(),
                  .tip = std::move(tip)};
    if (row.ci_low && row.ci_high) bar.interval = page::Range{*row.ci_low, *row.ci_high};
    return bar;
}

void add_table(page::Section& section, const records::TextTable& text)
{
    page::Table table{text.caption, {text.unit}};
    for (const std::string& head : text.heads) table.heads.emplace_back(head);
    const auto has_note = [](const records::TextTable::Row& row) { return !row.note.empty(); };
    const bool has_notes = std::any_of(text.rows.begin(), text.rows.end(), has_note);
    if (has_notes) table.heads.emplace_back("");
    for (const records::TextTable::Row& row : text.rows) {
        auto& cells = table.rows.emplace_back();
        cells.push_back({row.name});
        for (const std::string& cell : row.cells) cells.push_back({cell});
        cells.resize(text.heads.size() + 1, {""});
        if (has_notes) cells.push_back({row.note, "words"});
    }
    section.add(json_of(table));
    for (const std::string& remark : text.remarks) section.add(page::paragraph(remark));
}

} // namespace hapnet::lab::report
