// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/trace/columns.hpp"

#include "emulator/core/delay/bounds.hpp"
#include "proto/base/cells.hpp"
#include "proto/base/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator {

namespace {

struct Unit {
    std::string_view name;
    double factor;
};

/// A quantity that a header may name, with its units.
struct Wanted {
    std::string_view what;
    std::span<const Unit> units; // the first is that of a column whose name has no unit
    bool is_bare_allowed = false;
    double most = 0.0;
    std::string_view most_text{};
};

constexpr std::array<Unit, 4> time_units{{{"ns", 1.0}, {"us", 1e3}, {"ms", 1e6}, {"s", 1e9}}};
constexpr std::array<Unit, 3> share_units{{{"share", 1.0}, {"percent", 0.01}, {"%", 0.01}}};
constexpr std::array<Unit, 10> rate_units{{{"bps", 1.0},
                                           {"kbps", 1e3},
                                           {"Mbps", 1e6},
                                           {"mbps", 1e6},
                                           {"Gbps", 1e9},
                                           {"gbps", 1e9},
                                           {"bit/s", 1.0},
                                           {"kbit/s", 1e3},
                                           {"Mbit/s", 1e6},
                                           {"Gbit/s", 1e9}}};
constexpr double most_time = 1e19; // counted from an epoch, say: the first one is subtracted
constexpr Wanted wanted_time{"time", time_units, false, most_time, "too long"};

Wanted wanted(Measure measure)
{
    switch (measure) {
    case Measure::delay: {
        const auto most = static_cast<double>(longest_delay.count());
        return {"delay", time_units, false, most, "longer than 10^6 s"};
    }
    case Measure::loss: return {"loss", share_units, true, 1.0, "more than all"};
    case Measure::lost: return {"lost", {}, true, 1.0, "neither 0 (arrived) nor 1 (lost)"};
    case Measure::rate: break;
    }
    return {"rate", rate_units, false, 1e12, "more than 1 Tbit/s"};
}

std::string_view usual_names(Measure measure)
{
    switch (measure) {
    case Measure::delay: return "delay_ns, delay_us, delay_ms or delay_s";
    case Measure::loss: return "loss or loss_percent";
    case Measure::lost: return "lost";
    case Measure::rate: break;
    }
    return "rate_bps, rate_kbps, rate_Mbps or rate_Gbps";
}

/// An example of a unit.
std::string_view example_unit(Measure measure)
{
    switch (measure) {
    case Measure::delay: return ":ms";
    case Measure::loss: return ":share";
    case Measure::lost: return "";
    case Measure::rate: break;
    }
    return ":Mbps";
}

using LineCells = std::span<const std::string>;

std::string names_of_units(std::span<const Unit> units)
{
    std::string text;
    for (const Unit& unit : units) text += fmt::format("{}{}", text.empty() ? "" : ", ", unit.name);
    return text;
}

/// The place of a column that a person has named, in a header or by its number.
std::optional<std::size_t> place_of(LineCells cells, const std::string& name)
{
    const auto found = std::ranges::find(cells, name);
    if (found != cells.end()) return static_cast<std::size_t>(found - cells.begin());
    const auto number = base::parse_count(name, cells.size());
    if (!number || *number == 0) return std::nullopt;
    return static_cast<std::size_t>(*number) - 1;
}

using FoundColumn = base::Result<std::optional<NumberColumn>>;

/// The column that a person has named.
FoundColumn find_named(LineCells cells, const Wanted& want, const Column& column)
{
    const auto at = place_of(cells, column.name);
    if (!at) return base::fail(fmt::format("no column is named '{}'", shortened(column.name)));
    const bool is_number = std::ranges::find(cells, column.name) == cells.end();
    const auto name = is_number ? fmt::format("column {}", column.name) : column.name;
    for (const Unit& unit : want.units) {
        const bool is_it = column.unit.empty()
                               ? column.name.ends_with(fmt::format("_{}", unit.name))
                               : column.unit == unit.name;
        if (is_it) return NumberColumn{name, *at, unit.factor, want.most, want.most_text};
    }
    if (column.unit.empty() && want.is_bare_allowed) {
        return NumberColumn{name, *at, 1.0, want.most, want.most_text};
    }
    if (column.unit.empty()) {
        return base::fail(
            fmt::format("column '{0}' has no unit: write {1}={0}:UNIT with one of {2}",
                        shortened(column.name), want.what, names_of_units(want.units)));
    }
    return base::fail(
        fmt::format("unknown unit '{}' of {}: use {}", shortened(column.unit), want.what,
                    want.units.empty() ? "none" : "one of " + names_of_units(want.units)));
}

/// The column "<what>_<unit>", or the one that a person has named, if there is one.
FoundColumn find_column(LineCells cells, const Wanted& want, const Columns& columns)
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
        bool is_alone = !want.is_bare_allowed || take(want.what, 1.0);
        for (const Unit& unit : want.units) {
            is_alone = is_alone && take(fmt::format("{}_{}", want.what, unit.name), unit.factor);
            if (want.what == "time") {
                is_alone = is_alone && take(fmt::format("t_{}", unit.name), unit.factor);
            }
        }
        if (!is_alone) return base::fail(fmt::format("two columns of {}", want.what));
    }
    return found;
}

bool is_value(std::string_view cell) { return number_in(cell).has_value() || says_lost(cell); }

bool has_only_values(LineCells cells) { return std::ranges::all_of(cells, is_value); }

/// The cells of a table's first line, cut in one of the possible ways.
struct FirstLine {
    char separator = ';';
    std::vector<std::string> cells;
};

/// Finds the separator and the columns of a table.
class LayoutFinder {
public:
    LayoutFinder(const LineReader& lines, Measure measure, const Columns& columns)
        : line_{LineReader{lines}.next().value_or("")},
          measure_{measure},
          want_{wanted(measure)},
          columns_{columns}
    {
        for (const char separator : {'\t', ';', ',', ' '}) add_way(lines, separator);
        if (ways_.empty()) add_way(lines, ';', 1);
    }

    [[nodiscard]] base::Result<TableLayout> find() const
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
        base::Cells cells{{separator, true}};
        const auto line = LineReader{lines}.next_cells(cells);
        if (!line || !*line || (*line)->size() < cells_min) return;
        FirstLine way{separator, {(*line)->begin(), (*line)->end()}};
        // Blanks also stand within a text.
        if (separator == ' ' && !has_only_values(way.cells) && !finds_columns(way.cells)) return;
        ways_.push_back(std::move(way));
    }

    [[nodiscard]] bool is_wanted(const Column& column) const
    {
        return column.what == want_.what || column.what == wanted_time.what;
    }

    [[nodiscard]] bool finds_columns(LineCells cells) const
    {
        const bool is_named = std::ranges::any_of(
            columns_, [&](const Column& one) { return one.what == want_.what; });
        const auto found = find_column(cells, want_, columns_);
        const bool finds_named = std::ranges::all_of(columns_, [&](const Column& one) {
            return !is_wanted(one) || place_of(cells, one.name).has_value();
        });
        return finds_named && (is_named || !found || found->has_value());
    }

    /// Whether a line with these cells has all columns that were asked for. Where a person
    /// has numbered them, the strict way wants numbers in all cells.
    [[nodiscard]] bool has_what_is_wanted(LineCells cells, bool is_strict) const
    {
        const bool is_numbered = std::ranges::any_of(columns_, [&](const Column& one) {
            return is_wanted(one) && std::ranges::find(cells, one.name) == cells.end();
        });
        return finds_columns(cells) && (!is_strict || !is_numbered || has_only_values(cells));
    }

    [[nodiscard]] base::Result<TableLayout> layout(const FirstLine& way) const
    {
        const auto& cells = way.cells;
        const auto value = find_column(cells, want_, columns_);
        if (!value) return base::fail(value.error().message);
        const auto time = find_column(cells, wanted_time, columns_);
        if (!time) return base::fail(time.error().message);
        TableLayout layout{way.separator, cells.size(), **value, *time};
        const std::string& cell = cells[layout.value->place];
        layout.has_header = !is_value(cell) || cell == layout.value->name;
        const bool is_ambiguous = way.separator == ',' && !layout.has_header && cells.size() == 2 &&
                                  !layout.time &&
                                  line_.find_first_of(" \"") == std::string_view::npos;
        if (!is_ambiguous) return layout;
        return base::fail(fmt::format("'{}' may be one number with a decimal comma, or two: write "
                                      "a decimal point, or name the columns in a header",
                                      shortened(line_)));
    }

    /// The line has no column of the measure.
    [[nodiscard]] base::Result<TableLayout> without_columns() const
    {
        const FirstLine* most = nullptr;
        for (const FirstLine& way : ways_) {
            if (most == nullptr || way.cells.size() > most->cells.size()) most = &way;
        }
        if (most == nullptr) return base::fail("a quote is open or stands inside a cell");
        const auto& cells = most->cells;
        for (const Column& column : columns_) {
            if (!is_wanted(column) || place_of(cells, column.name)) continue;
            return base::fail(fmt::format("no column is named '{}'", shortened(column.name)));
        }
        if (cells.size() == 1 && measure_ == Measure::delay) return TableLayout{};
        const auto unit = example_unit(measure_);
        if (!has_only_values(cells)) {
            return base::fail(fmt::format("no column is named {}: rename one, or say which it is, "
                                          "such as columns \"{}={}{}\"",
                                          usual_names(measure_), want_.what,
                                          shortened(cells.back()), unit));
        }
        if (cells.size() == 1) {
            return base::fail(fmt::format("a column without a header: say what it is, such as "
                                          "columns \"{}=1{}\"",
                                          want_.what, unit));
        }
        return base::fail(fmt::format("{} columns without a header: name them by their numbers, "
                                      "such as columns \"time=1:s, {}=2{}\"",
                                      cells.size(), want_.what, unit));
    }

    std::string_view line_;
    Measure measure_;
    Wanted want_;
    const Columns& columns_;
    std::vector<FirstLine> ways_; // to cut the first line
};

} // namespace

std::string_view name_of(Measure measure) { return wanted(measure).what; }

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

base::Result<Columns> parse_columns(std::string_view text)
{
    constexpr std::array<std::string_view, 5> known{"time", "delay", "loss", "lost", "rate"};
    Columns columns;
    while (!trimmed(text).empty()) {
        const auto comma = text.find(',');
        const auto part = trimmed(text.substr(0, comma));
        text.remove_prefix(comma == std::string_view::npos ? text.size() : comma + 1);
        const auto equals = part.find('=');
        const auto what = trimmed(part.substr(0, equals));
        const bool is_known = std::ranges::find(known, what) != known.end();
        if (equals == std::string_view::npos || !is_known) {
            return base::fail(fmt::format("'{}' names no column: write time=NAME:UNIT, and "
                                          "likewise delay, loss, lost or rate",
                                          shortened(part)));
        }
        const auto rest = part.substr(equals + 1);
        const auto colon = rest.rfind(':');
        const auto name = trimmed(rest.substr(0, colon));
        if (name.empty()) {
            return base::fail(fmt::format("'{}' has no name of a column", shortened(part)));
        }
        const auto unit = colon == std::string_view::npos ? "" : trimmed(rest.substr(colon + 1));
        columns.push_back({std::string{what}, std::string{name}, std::string{unit}});
    }
    return columns;
}

base::Result<TableLayout> find_layout(const LineReader& lines, Measure measure,
                                      const Columns& columns)
{
    return LayoutFinder{lines, measure, columns}.find();
}

} // namespace hapnet::emulator
