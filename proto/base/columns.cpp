// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/columns.hpp"

#include "proto/base/cells.hpp"
#include "proto/base/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::base {

namespace {

using LineCells = std::span<const std::string>;

std::string names_of_units(std::span<const ColumnUnit> units)
{
    std::string text;
    for (const ColumnUnit& unit : units)
        text += fmt::format("{}{}", text.empty() ? "" : ", ", unit.name);
    return text;
}

/// Returns the index of a column that the user has named by its header or by its number.
std::optional<std::size_t> place_of(LineCells cells, const std::string& name)
{
    const auto found = std::ranges::find(cells, name);
    if (found != cells.end()) return static_cast<std::size_t>(found - cells.begin());
    const auto number = parse_count(name, cells.size());
    if (!number || *number == 0) return std::nullopt;
    return static_cast<std::size_t>(*number) - 1;
}

using FoundColumn = Result<std::optional<NumberColumn>>;

/// Finds the column that the user has named.
FoundColumn find_named(LineCells cells, const ColumnKind& want, const Column& column)
{
    const auto at = place_of(cells, column.name);
    if (!at) return fail(fmt::format("no column is named '{}'", shortened(column.name)));
    const bool is_number = std::ranges::find(cells, column.name) == cells.end();
    const auto name = is_number ? fmt::format("column {}", column.name) : column.name;
    for (const ColumnUnit& unit : want.units) {
        const bool is_it = column.unit.empty()
                               ? column.name.ends_with(fmt::format("_{}", unit.name))
                               : column.unit == unit.name;
        if (is_it) return NumberColumn{name, *at, unit.factor, want.most, want.most_text};
    }
    if (column.unit.empty() && want.bare_factor) {
        return NumberColumn{name, *at, *want.bare_factor, want.most, want.most_text};
    }
    if (column.unit.empty()) {
        return fail(fmt::format("column '{0}' has no unit: write {1}={0}:UNIT with one of {2}",
                                shortened(column.name), want.what, names_of_units(want.units)));
    }
    return fail(fmt::format("unknown unit '{}' of {}: use {}", shortened(column.unit), want.what,
                            want.units.empty() ? "none" : "one of " + names_of_units(want.units)));
}

/// Finds the column that the user has named, or else the column "<what>_<unit>".
FoundColumn find_column(LineCells cells, const ColumnKind& want, const Columns& columns)
{
    for (const Column& column : columns) {
        if (column.what == want.what) return find_named(cells, want, column);
    }
    std::optional<NumberColumn> found;
    for (std::size_t place = 0; place < cells.size(); ++place) {
        const auto take = [&](std::string_view name, double factor) {
            if (cells[place] != name) return true;
            if (found) return false;
            found = NumberColumn{std::string{name}, place, factor, want.most, want.most_text};
            return true;
        };
        bool is_alone = !want.bare_factor || take(want.what, *want.bare_factor);
        for (const ColumnUnit& unit : want.units) {
            is_alone = is_alone && take(fmt::format("{}_{}", want.what, unit.name), unit.factor);
            if (!want.short_name.empty()) {
                is_alone =
                    is_alone && take(fmt::format("{}_{}", want.short_name, unit.name), unit.factor);
            }
        }
        if (!is_alone) return fail(fmt::format("two columns of {}", want.what));
    }
    return found;
}

/// Returns all words but the first, as a list: "delay, loss, lost or rate".
std::string rest_of(std::span<const std::string_view> words)
{
    std::string text;
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::string_view before = i == 1 ? "" : i + 1 == words.size() ? " or " : ", ";
        text += fmt::format("{}{}", before, words[i]);
    }
    return text;
}

bool is_value(std::string_view cell) { return number_in(cell).has_value() || says_lost(cell); }

bool has_only_values(LineCells cells) { return std::ranges::all_of(cells, is_value); }

/// The cells of a table's first line, for one of the possible separators.
struct FirstLine {
    char separator = ';';
    std::vector<std::string> cells;
};

/// Finds the separator and the columns of a table.
class LayoutFinder {
public:
    LayoutFinder(const LineReader& lines, std::span<const ColumnKind> kinds, const Columns& columns)
        : line_{LineReader{lines}.next().value_or("")}, kinds_{kinds}, columns_{columns}
    {
        for (const char separator : {'\t', ';', ',', ' '}) add_way(lines, separator);
        if (ways_.empty()) add_way(lines, ';', 1);
    }

    [[nodiscard]] Result<TableLayout> find() const
    {
        for (const bool is_strict : {true, false}) {
            for (const FirstLine& way : ways_) {
                if (has_what_is_wanted(way.cells, is_strict)) return layout(way);
            }
        }
        return without_columns();
    }

private:
    void add_way(const LineReader& lines, char separator, std::size_t cells_min = 2)
    {
        Cells cells{{separator, true}};
        const auto line = LineReader{lines}.next_cells(cells);
        if (!line || !*line || (*line)->size() < cells_min) return;
        FirstLine way{separator, {(*line)->begin(), (*line)->end()}};
        // A text can also contain blanks.
        if (separator == ' ' && !has_only_values(way.cells) && !finds_columns(way.cells)) return;
        ways_.push_back(std::move(way));
    }

    [[nodiscard]] bool is_wanted(const Column& column) const
    {
        return std::ranges::find(kinds_, column.what, &ColumnKind::what) != kinds_.end();
    }

    [[nodiscard]] bool finds_column(LineCells cells, const ColumnKind& kind) const
    {
        const bool is_named =
            std::ranges::any_of(columns_, [&](const Column& one) { return one.what == kind.what; });
        const auto found = find_column(cells, kind, columns_);
        return is_named || !found || found->has_value();
    }

    [[nodiscard]] bool finds_columns(LineCells cells) const
    {
        const bool finds_named = std::ranges::all_of(columns_, [&](const Column& one) {
            return !is_wanted(one) || place_of(cells, one.name).has_value();
        });
        return finds_named && std::ranges::all_of(kinds_, [&](const ColumnKind& kind) {
                   return kind.is_optional || finds_column(cells, kind);
               });
    }

    /// True if a line with these cells has all columns that were asked for. If the user has
    /// numbered them, `is_strict` requires numbers in all cells.
    [[nodiscard]] bool has_what_is_wanted(LineCells cells, bool is_strict) const
    {
        const bool is_numbered = std::ranges::any_of(columns_, [&](const Column& one) {
            return is_wanted(one) && std::ranges::find(cells, one.name) == cells.end();
        });
        return finds_columns(cells) && (!is_strict || !is_numbered || has_only_values(cells));
    }

    [[nodiscard]] Result<TableLayout> layout(const FirstLine& way) const
    {
        const auto& cells = way.cells;
        TableLayout layout{way.separator, cells.size(), {}};
        std::size_t found = 0;
        for (const ColumnKind& kind : kinds_) {
            auto column = find_column(cells, kind, columns_);
            if (!column) return fail(column.error().message);
            found += column->has_value() ? 1U : 0U;
            layout.columns.push_back(*std::move(column));
        }
        const NumberColumn& first = *layout.columns.front();
        const std::string& cell = cells[first.place];
        layout.has_header = !is_value(cell) || cell == first.name;
        const bool is_ambiguous = way.separator == ',' && !layout.has_header && cells.size() == 2 &&
                                  found == 1 &&
                                  line_.find_first_of(" \"") == std::string_view::npos;
        if (!is_ambiguous) return layout;
        return fail(fmt::format("'{}' may be one number with a decimal comma, or two: write "
                                "a decimal point, or name the columns in a header",
                                shortened(line_)));
    }

    /// Returns the first kind that a line lacks.
    [[nodiscard]] const ColumnKind& missing_in(LineCells cells) const
    {
        const auto lacks = [&](const ColumnKind& kind) {
            return !kind.is_optional && !finds_column(cells, kind);
        };
        const auto found = std::ranges::find_if(kinds_, lacks);
        return found == kinds_.end() ? kinds_.front() : *found;
    }

    /// Returns the result for a line that lacks a column.
    [[nodiscard]] Result<TableLayout> without_columns() const
    {
        const FirstLine* most = nullptr;
        for (const FirstLine& way : ways_) {
            if (most == nullptr || way.cells.size() > most->cells.size()) most = &way;
        }
        if (most == nullptr) return fail("a quote is open or stands inside a cell");
        const auto& cells = most->cells;
        for (const Column& column : columns_) {
            if (!is_wanted(column) || place_of(cells, column.name)) continue;
            return fail(fmt::format("no column is named '{}'", shortened(column.name)));
        }
        const ColumnKind& kind = missing_in(cells);
        if (cells.size() == 1 && kind.may_stand_alone)
            return TableLayout{.columns = {kinds_.size(), std::nullopt}};
        if (!has_only_values(cells)) {
            return fail(fmt::format("no column is named {}: rename one, or say which it is, "
                                    "such as columns \"{}={}{}\"",
                                    kind.usual_names, kind.what, shortened(cells.back()),
                                    kind.example_unit));
        }
        if (cells.size() == 1) {
            return fail(fmt::format("a column without a header: say what it is, such as "
                                    "columns \"{}=1{}\"",
                                    kind.what, kind.example_unit));
        }
        return fail(fmt::format("{} columns without a header: name them by their numbers, "
                                "such as columns \"time=1:s, {}=2{}\"",
                                cells.size(), kind.what, kind.example_unit));
    }

    std::string_view line_;
    std::span<const ColumnKind> kinds_;
    const Columns& columns_;
    std::vector<FirstLine> ways_; // possible divisions of the first line
};

} // namespace

std::optional<WrittenNumber> number_in(std::string_view cell)
{
    constexpr std::size_t longest = 64;
    const auto mark = cell.find_first_of(".,");
    if (cell.size() > longest) return std::nullopt;
    std::array<char, longest> plain{};
    std::ranges::copy(cell, plain.begin());
    if (mark != std::string_view::npos) plain.at(mark) = '.';
    double value = 0.0;
    const auto* const stop = plain.data() + cell.size();
    const auto [end, error] = std::from_chars(plain.data(), stop, value);
    if (error != std::errc{} || end != stop || !std::isfinite(value)) return std::nullopt;
    return WrittenNumber{value, mark == std::string_view::npos ? '\0' : cell[mark]};
}

bool says_lost(std::string_view cell)
{
    constexpr std::array<std::string_view, 6> words{"", "nan", "-", "*", "lost", "timeout"};
    constexpr std::size_t longest = 7;
    if (cell.size() > longest) return false;
    std::string lower;
    for (const char c : cell) {
        lower += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    return std::ranges::find(words, lower) != words.end();
}

Result<Columns> parse_columns(std::string_view text, std::span<const std::string_view> known)
{
    Columns columns;
    while (!trimmed(text).empty()) {
        const auto comma = text.find(',');
        const auto part = trimmed(text.substr(0, comma));
        text.remove_prefix(comma == std::string_view::npos ? text.size() : comma + 1);
        const auto equals = part.find('=');
        const auto what = trimmed(part.substr(0, equals));
        const bool is_known = std::ranges::find(known, what) != known.end();
        if (equals == std::string_view::npos || !is_known) {
            return fail(fmt::format("'{}' names no column: write {}=NAME:UNIT, and likewise {}",
                                    shortened(part), known.front(), rest_of(known)));
        }
        const auto rest = part.substr(equals + 1);
        const auto colon = rest.rfind(':');
        const auto name = trimmed(rest.substr(0, colon));
        if (name.empty()) {
            return fail(fmt::format("'{}' has no name of a column", shortened(part)));
        }
        const auto unit = colon == std::string_view::npos ? "" : trimmed(rest.substr(colon + 1));
        columns.push_back({std::string{what}, std::string{name}, std::string{unit}});
    }
    return columns;
}

Result<double> NumberReader::read(std::string_view cell, const NumberColumn& column)
{
    const auto number = number_in(cell);
    if (!number) {
        const bool has_both =
            cell.find(',') != std::string_view::npos && cell.find('.') != std::string_view::npos;
        return fail(fmt::format("{} '{}' is not a number{}", column.name, shortened(cell),
                                has_both ? ": write it without separators of thousands" : ""));
    }
    if (number->mark == '\0') return number->value;
    if (mark_ != '\0' && number->mark != mark_) {
        return fail(fmt::format("{} '{}' has a decimal {} where lines before it have a {}: write "
                                "all numbers in one way",
                                column.name, shortened(cell), mark_ == '.' ? "comma" : "point",
                                mark_ == '.' ? "point" : "comma"));
    }
    mark_ = number->mark;
    return number->value;
}

std::string refusal_of_cells(std::size_t cells, const TableLayout& layout)
{
    const auto text = fmt::format("{} cell{} where the {} has {}", cells, cells == 1 ? "" : "s",
                                  layout.has_header ? "header" : "first line", layout.cells);
    const bool may_be_decimal = layout.separator == ',' && cells == 2 * layout.cells;
    return text + (may_be_decimal ? ": with decimal commas, separate cells by semicolons" : "");
}

Result<TableLayout> find_layout(const LineReader& lines, std::span<const ColumnKind> kinds,
                                const Columns& columns)
{
    return LayoutFinder{lines, kinds, columns}.find();
}

} // namespace hapnet::base
