// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/trace/rows.hpp"

#include "emulator/core/delay/bounds.hpp"
#include "proto/base/text.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <tuple>
#include <utility>

namespace hapnet::emulator {

namespace {

/// Collects rows one after the other.
class Rows {
public:
    Rows(Measure measure, base::TableLayout layout) : measure_{measure}, layout_{std::move(layout)}
    {}

    [[nodiscard]] bool is_full() const { return rows_.values.size() == trace_rows_max; }

    [[nodiscard]] base::Result<void> add(std::span<const std::string_view> cells)
    {
        if (cells.size() != layout_.cells)
            return base::fail(refusal_of_cells(cells.size(), layout_));
        const auto cell = cells[value_of(layout_)->place];
        const bool is_lost = measure_ == Measure::delay && base::says_lost(cell);
        if (!is_lost) {
            const auto value = parse_cell(cell, *value_of(layout_));
            if (!value) return tl::unexpected{value.error()};
            last_ = *value * value_of(layout_)->factor;
        }
        rows_.values.push_back(last_);
        rows_.lost.push_back(is_lost);
        return time_column(layout_) ? add_time(cells[time_column(layout_)->place])
                                    : base::Result<void>{};
    }

    /// Adds `count` lost datagrams, unless no value has come yet. Returns false if there is no room
    /// for them.
    [[nodiscard]] bool add_lost(std::size_t count)
    {
        if (rows_.values.empty()) return true;
        if (count > trace_rows_max - rows_.values.size()) return false;
        rows_.values.insert(rows_.values.end(), count, last_);
        rows_.lost.insert(rows_.lost.end(), count, true);
        return true;
    }

    /// Adds a delay with its unit.
    [[nodiscard]] base::Result<void> add_delay(std::string_view line)
    {
        const auto delay = base::parse_duration(line);
        if (delay) {
            rows_.values.push_back(static_cast<double>(delay->count()));
            rows_.lost.push_back(false);
            return {};
        }
        const auto text = base::shortened(line);
        if (base::number_in(line)) {
            return base::fail(fmt::format("'{0}' has no unit: write {0}ms in each line, or say "
                                          "columns \"delay=1:ms\"",
                                          text));
        }
        if (text != line) return base::fail(fmt::format("'{}' is not a duration", text));
        return tl::unexpected{delay.error()};
    }

    /// Returns the rows; nullopt: they have no value.
    [[nodiscard]] std::optional<TraceRows> finished()
    {
        const auto first = std::ranges::find(rows_.lost, false);
        if (first == rows_.lost.end()) return std::nullopt;
        const auto start = first - rows_.lost.begin();
        std::fill_n(rows_.values.begin(), start, rows_.values[static_cast<std::size_t>(start)]);
        return std::move(rows_);
    }

private:
    [[nodiscard]] base::Result<double> parse_cell(std::string_view cell,
                                                  const base::NumberColumn& column)
    {
        auto number = numbers_.read(cell, column);
        if (!number) return number;
        const double count = *number;
        if (count < 0.0) return base::fail(fmt::format("{} {} is negative", column.name, count));
        const bool is_wrong_flag = measure_ == Measure::lost && &column == &*value_of(layout_) &&
                                   count != 0.0 && count != 1.0;
        if (is_wrong_flag || count * column.factor > column.most) {
            return base::fail(fmt::format("{} {} is {}", column.name, count, column.most_text));
        }
        return count;
    }

    [[nodiscard]] base::Result<void> add_time(std::string_view cell)
    {
        const auto count = parse_cell(cell, *time_column(layout_));
        if (!count) return tl::unexpected{count.error()};
        if (rows_.times.empty()) first_time_ = *count;
        const double passed = (*count - first_time_) * time_column(layout_)->factor;
        if (std::abs(passed) > static_cast<double>(longest_delay.count())) {
            return base::fail(fmt::format("{} {} is more than 10^6 s from the first one",
                                          time_column(layout_)->name, *count));
        }
        const base::Duration time{std::llround(passed)};
        if (!rows_.times.empty() && time <= rows_.times.back()) {
            return base::fail(fmt::format("{} is not later than {}", base::to_text(time),
                                          base::to_text(rows_.times.back())));
        }
        rows_.times.push_back(time);
        return {};
    }

    Measure measure_;
    base::TableLayout layout_;
    TraceRows rows_;
    double last_ = 0.0;
    double first_time_ = 0.0;
    base::NumberReader numbers_;
};

/// Returns the columns. With a slot, a first line that is one number is a delay in ms.
base::Columns columns_of(const TableFormat& format, Measure measure, const base::LineReader& lines)
{
    base::Columns columns = format.columns;
    const auto is_delay = [](const base::Column& one) { return one.what == "delay"; };
    const bool is_open = format.slot > base::Duration{0} && measure == Measure::delay &&
                         std::ranges::none_of(columns, is_delay);
    const auto first = base::LineReader{lines}.next().value_or("");
    if (is_open && (base::number_in(first) || (!first.empty() && base::says_lost(first)))) {
        columns.push_back({"delay", "1", "ms"});
    }
    return columns;
}

base::Result<void> add_slots(TraceRows& rows, base::Duration slot)
{
    if (slot == base::Duration{0}) return {};
    if (!rows.times.empty()) {
        return base::fail("line 1: the file has times of its own: leave out slot");
    }
    const auto count = static_cast<base::Duration::rep>(rows.values.size());
    if (slot > longest_delay / count) {
        return base::fail(fmt::format("line 1: {} slots of {} are longer than 10^6 s", count,
                                      base::to_text(slot)));
    }
    rows.times.reserve(rows.values.size());
    for (base::Duration::rep i = 0; i < count; ++i) rows.times.push_back(i * slot);
    return {};
}

} // namespace

base::Result<TableFormat> parse_format(std::string_view columns, base::Duration slot)
{
    auto named = parse_columns(columns);
    if (!named) return base::fail(fmt::format("columns: {}", named.error().message));
    if (slot < base::Duration{0}) return base::fail("slot must not be negative");
    return TableFormat{*std::move(named), slot};
}

std::vector<base::Duration> TraceRows::delays() const
{
    std::vector<base::Duration> all;
    all.reserve(values.size());
    for (const double value : values) all.emplace_back(std::llround(value));
    return all;
}

base::Result<TraceRows> read_trace_rows(std::string_view text, Measure measure,
                                        const TableFormat& format)
{
    base::LineReader lines{text};
    const auto nothing = [&] {
        return lines.fail(fmt::format("the file ends without a {}", name_of(measure)));
    };
    if (!base::LineReader{lines}.next()) {
        std::ignore = lines.next(); // reads to the end of the text
        return nothing();
    }
    const auto layout = find_layout(lines, measure, columns_of(format, measure, lines));
    if (!layout) {
        std::ignore = lines.next();
        return lines.fail(layout.error().message);
    }
    base::Cells cells{{layout->separator, true}};
    if (layout->has_header) std::ignore = lines.next_cells(cells);
    Rows rows{measure, *layout};
    const bool has_empty_rows = measure == Measure::delay && layout->cells == 1;
    for (;;) {
        base::Result<void> added;
        if (value_of(*layout)) {
            const auto line = lines.next_cells(cells);
            if (!line) return tl::unexpected{line.error()};
            if (!*line) break;
            if (has_empty_rows && !rows.add_lost(lines.skipped_empty()))
                return lines.fail(too_many_values);
            if (rows.is_full()) return lines.fail(too_many_values);
            added = rows.add(**line);
        } else {
            const auto line = lines.next();
            if (!line) break;
            if (rows.is_full()) return lines.fail(too_many_values);
            added = rows.add_delay(*line);
        }
        if (!added) return lines.fail(added.error().message);
    }
    auto found = rows.finished();
    if (!found) return nothing();
    if (const auto timed = add_slots(*found, format.slot); !timed) {
        return tl::unexpected{timed.error()};
    }
    return *std::move(found);
}

} // namespace hapnet::emulator
