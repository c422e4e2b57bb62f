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

// Functions that make figures from the rows of a table: selections of rows, words about a row, bars
// and curves.

using results::Rows;
using results::Table;
using results::TableRow;

/// Returns the mean of the values; there is at least one.
[[nodiscard]] double mean_of(const std::vector<double>& values);
/// Returns the distinct texts in a column, in the order in which they occur.
[[nodiscard]] std::vector<std::string> distinct(const Rows& rows, std::string_view key);
/// Returns the rows with this text in the column.
[[nodiscard]] Rows where(const Rows& rows, std::string_view key, std::string_view text);
/// Returns the rows in groups. The rows of a group have equal texts in these columns.
[[nodiscard]] std::vector<Rows> split(const Rows& rows, std::span<const std::string_view> keys);
/// Returns the table with one more column.
[[nodiscard]] Table with_column(Table table, std::string key,
                                const std::function<results::Cell(const TableRow&)>& cell_of);

/// Returns a number with this number of decimals as a text; "–" for none.
[[nodiscard]] std::string shown(std::optional<double> value, int decimals);

/// True if a value has an interval in the columns ci_low and ci_high. A value of one seed has none.
[[nodiscard]] bool has_interval(const TableRow& row);
/// Returns the width of an algorithm's curve, in pixels. The curve of sep is often under that of
/// base and must stay visible there.
[[nodiscard]] double curve_width(std::string_view algorithm);
/// Describes the error bar of a result of `seeds` seeds: "its 95 % interval", or "from the least to
/// the most of the 3 seeds" if the seeds are too few for an interval. Returns "" for one seed,
/// which has no bar.
[[nodiscard]] std::string about_spread(double seeds);

/// Translates a name that programs use into words for people: "burst loss", "%".
[[nodiscard]] std::string people_say(std::string_view name);

/// Returns a text in which {key} is replaced by a cell: {key:.2} by a number with two decimals,
/// {key:g} by one with as many digits as needed, {key:limit} by one with as many digits as a limit
/// is accurate to. Names that programs use are replaced by words for people: "burst loss", "%".
[[nodiscard]] std::string in_words(std::string_view pattern, const TableRow& row);

/// Returns the colour of an algorithm, the same on every page. All algorithms that are not built in
/// share one.
[[nodiscard]] std::string_view colour_of(std::string_view algorithm);

/// The pattern of one bar for each row. Its value is in a column; the other members are patterns.
/// The columns bound, missed, ci_low and ci_high describe a bar further if it is not outlined.
struct BarPattern {
    std::string series;
    std::string value; // key of a column; a row without a number there has no such bar
    std::string text;
    std::string tip;
    bool is_outlined = false; // true for values that others measured
};
/// Returns the bars. There is one group for each text that the pattern `group` produces.
[[nodiscard]] page::Bars bars_of(const Rows& rows, std::string_view group,
                                 std::span<const BarPattern> bars);

/// The rule by which several values at one x become points of a curve. each: every value is a
/// point. median: the median is, with all values as dots beside it. mean: the mean is, with its
/// interval as a band where there are several values.
enum class Together : std::uint8_t { each, median, mean };

/// A curve for each algorithm through the numbers in two columns.
struct CurvePattern {
    std::string_view x; // keys of the columns with x and y
    std::string_view y;
    Together together = Together::each;
    bool is_line = true; // false: points only
    bool shows_points = false;
};
[[nodiscard]] std::vector<page::Curve> curves_of(const Rows& rows, const CurvePattern& pattern);

} // namespace hapnet::lab::report
