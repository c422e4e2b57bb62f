// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/results/table.hpp"
#include "proto/page/figure.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::lab::report {

// From the rows of a table to figures: selections of rows, words about a row, bars and curves.

using results::Rows;
using results::Table;
using results::TableRow;

/// The mean of the values; at least one.
[[nodiscard]] double mean_of(const std::vector<double>& values);
/// The texts in a column, each once, in the order in which they come.
[[nodiscard]] std::vector<std::string> distinct(const Rows& rows, std::string_view key);
/// The rows with this text in the column.
[[nodiscard]] Rows where(const Rows& rows, std::string_view key, std::string_view text);
/// The rows in groups, each with equal texts in these columns.
[[nodiscard]] std::vector<Rows> split(const Rows& rows, std::span<const std::string_view> keys);
/// The table with a further column.
[[nodiscard]] Table with_column(Table table, std::string key,
                                const std::function<results::Cell(const TableRow&)>& cell_of);

/// Returns a number with this number of decimals as a text; "–" for none.
[[nodiscard]] std::string shown(std::optional<double> value, int decimals);

/// True if a value has an interval in the columns ci_low and ci_high: of one seed there is none.
[[nodiscard]] bool has_interval(const TableRow& row);
/// The width of an algorithm's curve, in pixels. sep often lies under base and must stay visible
/// there.
[[nodiscard]] double curve_width(std::string_view algorithm);
/// The meaning of the line about a result of `seeds` seeds: "its 95 % interval"; "from the least to
/// the most of the 3 seeds" of fewer than can give one; "" of one seed, which has no line.
[[nodiscard]] std::string about_spread(double seeds);

/// Translates a program's name for something into people's words: "burst loss", "%".
[[nodiscard]] std::string people_say(std::string_view name);

/// A text in which {key} stands for a cell: {key:.2} for a number with two decimals, {key:g} for
/// one with as many digits as it takes, {key:limit} for one with as many digits as a limit is
/// worth. Names that programs use are replaced by people's words: "burst loss", "%".
[[nodiscard]] std::string in_words(std::string_view pattern, const TableRow& row);

/// The colour of an algorithm, the same on every page; all that are not built in share one.
[[nodiscard]] std::string_view colour_of(std::string_view algorithm);

/// The pattern of one bar for each row. Its value stands in a column, the rest are patterns. The
/// columns bound, missed, ci_low and ci_high say more about a bar that is not outlined.
struct BarPattern {
    std::string series;
    std::string value; // key of a column; a row without a number there has no such bar
    std::string text;
    std::string tip;
    bool is_outlined = false; // true for values that others measured
};
/// A group for each text that the pattern of groups gives.
[[nodiscard]] page::Bars bars_of(const Rows& rows, std::string_view group,
                                 std::span<const BarPattern> bars);

/// The way in which several values at one x become points of a curve: each; the median, beside
/// which all are dots; or the mean, with its interval as a band where there are several.
enum class Together : std::uint8_t { each, median, mean };

/// A curve of each algorithm through what stands in two columns.
struct CurvePattern {
    std::string_view x; // keys of the columns with x and y
    std::string_view y;
    Together together = Together::each;
    bool is_line = true; // false: points only
    bool shows_points = false;
};
[[nodiscard]] std::vector<page::Curve> curves_of(const Rows& rows, const CurvePattern& pattern);

} // namespace hapnet::lab::report
