// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/records/text_table.hpp"
#include "lab/results/results.hpp"
#include "proto/page/page.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace hapnet::lab::report {

// How numbers, names and tables are written on a page.

/// With so many decimals; "–" for none.
[[nodiscard]] std::string shown(std::optional<double> value, int decimals);
/// As many digits as it takes: "160", "4.5".
[[nodiscard]] std::string plain(double value);
/// "> 320 ms", "93 %", "40 of 100": a limit and its bound.
[[nodiscard]] std::string limit_text(double limit, bool is_open, std::string_view unit);
/// "ms", "%", "of 100"
[[nodiscard]] std::string_view unit_text(std::string_view unit);
/// "delay", "burst loss"; an unknown name stays as it is.
[[nodiscard]] std::string impairment_text(std::string_view impairment);

[[nodiscard]] std::string_view claim_text(results::Claim claim); // "calibrated"
[[nodiscard]] page::Json claim_badge(results::Claim claim);      // "" for none
/// The class of a number and its verdict against the paper's.
[[nodiscard]] page::Json class_badge(results::Provenance provenance);
[[nodiscard]] page::Json status_badge(results::LimitStatus status);
[[nodiscard]] std::string_view tier_symbol(metrics::Tier tier);
[[nodiscard]] page::Json tier_badge(metrics::Tier tier);
[[nodiscard]] std::string_view tier_colour(metrics::Tier tier);

/// The colour of an algorithm, the same all over the page; of what a person need not tell apart
/// the same.
[[nodiscard]] std::string_view colour_of(std::string_view algorithm);

/// How thick its curve is, in pixels: sep often lies under base, and is to be seen there.
[[nodiscard]] double curve_width(std::string_view algorithm);

/// What differs in these rows, in the order in which it comes.
template <typename Value, typename Name>
[[nodiscard]] auto distinct(const std::vector<Value>& rows, const Name& name)
{
    std::vector<std::decay_t<decltype(name(rows.front()))>> found;
    for (const Value& row : rows) {
        const auto one = name(row);
        if (std::find(found.begin(), found.end(), one) == found.end()) found.push_back(one);
    }
    return found;
}

/// The rows of which `keeps` is true.
template <typename Value, typename Keeps>
[[nodiscard]] std::vector<Value> rows_where(const std::vector<Value>& rows, const Keeps& keeps)
{
    std::vector<Value> kept;
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(kept), keeps);
    return kept;
}

/// As many digits as a limit is worth.
[[nodiscard]] std::string rounded_limit(double limit);
/// The bar of a limit with its interval, open where it is a bound.
[[nodiscard]] page::Bar limit_bar(const results::LimitRow& row, std::string series,
                                  std::string tip);

/// Adds what a terminal shows as text, with its remarks below.
void add_table(page::Section& section, const records::TextTable& text);

} // namespace hapnet::lab::report
