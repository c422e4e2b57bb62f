// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/trace/rows.hpp"

#include "emulator/core/delay/bounds.hpp"
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

std::string_view trimmed(std::string_view text)
{
    constexpr std::string_view blanks = " \t\r\f\v";
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    return text.substr(0, text.find_last_not_of(blanks) + 1);
}

std::vector<std::string_view> cells_of(std::string_view line)
{
    std::vector<std::string_view> cells;
    for (;;) {
        const auto comma = line.find(',');
        cells.push_back(trimmed(line.substr(0, comma)));
        if (comma == std::string_view::npos) return cells;
        line.remove_prefix(comma + 1);
    }
}

struct Unit {
    std::string_view name;
    double factor;
};

/// What is looked for in a header.
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

Wanted wanted(Measure measure)
{
    switch (measure) {
    case Measure::delay: {
        const auto most = static_cast<double>(longest_delay.count());
        return {"delay", time_units, false, most, "longer than 10^6 s"};
    }
    case Measure::loss: return {"loss", share_units, true, 1.0, "more than all"};
    case Measure::rate: break;
    }
    return {"rate", rate_units, false, 1e12, "more than 1 Tbit/s"};
}

/// A column of numbers that are written without their unit.
struct NumberColumn {
    std::string name;
    std::size_t place = 0;
    double factor = 1.0;
    double most = 0.0;
    std::string_view most_text{};
};

struct Header {
    std::size_t cells = 0;
    NumberColumn value;
    std::optional<NumberColumn> time;
};

std::string names_of_units(std::span<const Unit> units)
{
    std::string text;
    for (const Unit& unit : units) text += fmt::format("{}{}", text.empty() ? "" : ", ", unit.name);
    return text;
}

using FoundColumn = base::Result<std::optional<NumberColumn>>;

/// The column that a person has named.
FoundColumn find_named(const std::vector<std::string_view>& cells, const Wanted& want,
                       const Column& column)
{
    const auto place = std::find(cells.begin(), cells.end(), column.name);
    if (place == cells.end()) {
        return base::fail(fmt::format("no column is named '{}'", shortened(column.name)));
    }
    const auto at = static_cast<std::size_t>(place - cells.begin());
    for (const Unit& unit : want.units) {
        const bool is_it = column.unit.empty()
                               ? column.name.ends_with(fmt::format("_{}", unit.name))
                               : column.unit == unit.name;
        if (is_it) return NumberColumn{column.name, at, unit.factor, want.most, want.most_text};
    }
    if (column.unit.empty() && want.is_bare_allowed) {
        return NumberColumn{column.name, at, 1.0, want.most, want.most_text};
    }
    if (column.unit.empty()) {
        return base::fail(
            fmt::format("column '{0}' has no unit: write {1}={0}:UNIT with one of {2}",
                        shortened(column.name), want.what, names_of_units(want.units)));
    }
    return base::fail(fmt::format("unknown unit '{}' of {}: use one of {}", shortened(column.unit),
                                  want.what, names_of_units(want.units)));
}

/// The column "<what>_<unit>", or the one that a person has named, if there is one.
FoundColumn find_column(const std::vector<std::string_view>& cells, const Wanted& want,
                        const Columns& columns)
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

std::string_view usual_names(Measure measure)
{
    switch (measure) {
    case Measure::delay: return "delay_ns, delay_us, delay_ms or delay_s";
    case Measure::loss: return "loss or loss_percent";
    case Measure::rate: break;
    }
    return "rate_bps, rate_kbps, rate_Mbps or rate_Gbps";
}

/// The header that a line is; nullopt when the line is a delay.
base::Result<std::optional<Header>> parse_header(std::string_view line, Measure measure,
                                                 const Columns& columns)
{
    const auto cells = cells_of(line);
    const auto value = find_column(cells, wanted(measure), columns);
    if (!value) return base::fail(value.error().message);
    if (!*value) {
        if (cells.size() == 1 && measure == Measure::delay) return std::nullopt;
        return base::fail(fmt::format("no column is named {}", usual_names(measure)));
    }
    const auto time =
        find_column(cells, {"time", time_units, false, most_time, "too long"}, columns);
    if (!time) return base::fail(time.error().message);
    return Header{cells.size(), **value, *time};
}

base::Result<double> parse_cell(std::string_view cell, const NumberColumn& column)
{
    double count = 0.0;
    const auto [end, error] = std::from_chars(cell.begin(), cell.end(), count);
    if (error != std::errc{} || end != cell.end() || !std::isfinite(count)) {
        return base::fail(fmt::format("{} '{}' is not a number", column.name, shortened(cell)));
    }
    if (count < 0.0) return base::fail(fmt::format("{} {} is negative", column.name, count));
    if (count * column.factor > column.most) {
        return base::fail(fmt::format("{} {} is {}", column.name, count, column.most_text));
    }
    return count;
}

bool says_lost(std::string_view cell)
{
    std::string lower;
    for (const char c : cell.substr(0, 8)) {
        lower += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    constexpr std::array<std::string_view, 6> words{"", "nan", "-", "*", "lost", "timeout"};
    return std::find(words.begin(), words.end(), lower) != words.end();
}

/// Adds one row after the other.
class Rows {
public:
    Rows(Measure measure, std::optional<Header> header)
        : measure_{measure}, header_{std::move(header)}
    {}

    [[nodiscard]] bool is_full() const { return rows_.values.size() == trace_rows_max; }

    [[nodiscard]] base::Result<void> add(std::string_view line)
    {
        return header_ ? add_row(line) : add_delay(line);
    }

    /// What there is; nullopt: not one value.
    [[nodiscard]] std::optional<TraceRows> finished()
    {
        const auto first = std::find(rows_.lost.begin(), rows_.lost.end(), false);
        if (first == rows_.lost.end()) return std::nullopt;
        const auto start = first - rows_.lost.begin();
        std::fill_n(rows_.values.begin(), start, rows_.values[static_cast<std::size_t>(start)]);
        return std::move(rows_);
    }

private:
    [[nodiscard]] base::Result<void> add_row(std::string_view line)
    {
        const auto cells = cells_of(line);
        if (cells.size() != header_->cells) {
            return base::fail(
                fmt::format("{} cells where the header has {}", cells.size(), header_->cells));
        }
        const auto cell = cells[header_->value.place];
        const bool is_lost = measure_ == Measure::delay && says_lost(cell);
        if (!is_lost) {
            const auto value = parse_cell(cell, header_->value);
            if (!value) return tl::unexpected{value.error()};
            last_ = *value * header_->value.factor;
        }
        rows_.values.push_back(last_);
        rows_.lost.push_back(is_lost);
        return header_->time ? add_time(cells[header_->time->place]) : base::Result<void>{};
    }

    [[nodiscard]] base::Result<void> add_time(std::string_view cell)
    {
        const auto count = parse_cell(cell, *header_->time);
        if (!count) return tl::unexpected{count.error()};
        if (rows_.times.empty()) first_time_ = *count;
        const double passed = (*count - first_time_) * header_->time->factor;
        if (std::abs(passed) > static_cast<double>(longest_delay.count())) {
            return base::fail(fmt::format("{} {} is more than 10^6 s from the first one",
                                          header_->time->name, *count));
        }
        const base::Duration time{std::llround(passed)};
        if (!rows_.times.empty() && time <= rows_.times.back()) {
            return base::fail(fmt::format("{} is not later than {}", base::to_text(time),
                                          base::to_text(rows_.times.back())));
        }
        rows_.times.push_back(time);
        return {};
    }

    [[nodiscard]] base::Result<void> add_delay(std::string_view line)
    {
        const auto delay = base::parse_duration(line);
        if (delay) {
            rows_.values.push_back(static_cast<double>(delay->count()));
            rows_.lost.push_back(false);
            return {};
        }
        const auto text = shortened(line);
        if (text.find_first_not_of("0123456789.") == std::string::npos) {
            return base::fail(fmt::format("'{}' has no unit: write {}ms", text, text));
        }
        if (text != line) return base::fail(fmt::format("'{}' is not a duration", text));
        return tl::unexpected{delay.error()};
    }

    Measure measure_;
    std::optional<Header> header_;
    TraceRows rows_;
    double last_ = 0.0;
    double first_time_ = 0.0;
};

} // namespace

LineReader::LineReader(std::string_view text) : rest_{text}
{
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (rest_.substr(0, 3) == byte_order_mark) rest_.remove_prefix(3);
}

std::optional<std::string_view> LineReader::next()
{
    while (!rest_.empty()) {
        ++number_;
        const auto end = rest_.find('\n');
        const auto line = trimmed(rest_.substr(0, end));
        rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
        if (!line.empty() && line.front() != '#') return line;
    }
    return std::nullopt;
}

tl::unexpected<base::Error> LineReader::fail(std::string_view why) const
{
    return base::fail(fmt::format("line {}: {}", std::max<std::size_t>(number_, 1), why));
}

std::string shortened(std::string_view text)
{
    constexpr std::size_t most = 40;
    std::string out;
    for (const char c : text.substr(0, most)) {
        const auto code = static_cast<unsigned char>(c);
        out += code < 0x20 || code == 0x7F ? '?' : c;
    }
    if (text.size() > most) out += "...";
    return out;
}

base::Result<Columns> parse_columns(std::string_view text)
{
    constexpr std::array<std::string_view, 5> known{"time", "delay", "loss", "lost", "rate"};
    Columns columns;
    if (trimmed(text).empty()) return columns;
    for (const std::string_view part : cells_of(text)) {
        const auto equals = part.find('=');
        const auto what = trimmed(part.substr(0, equals));
        const bool is_known = std::find(known.begin(), known.end(), what) != known.end();
        if (equals == std::string_view::npos || !is_known) {
            return base::fail(
                fmt::format("'{}' names no column: write time=NAME:UNIT, and likewise "
                            "delay, loss, lost or rate",
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

std::vector<base::Duration> TraceRows::delays() const
{
    std::vector<base::Duration> all;
    all.reserve(values.size());
    for (const double value : values) all.emplace_back(std::llround(value));
    return all;
}

base::Result<TraceRows> read_trace_rows(std::string_view text, Measure measure,
                                        const Columns& columns)
{
    std::optional<Rows> rows;
    LineReader lines{text};
    while (const auto line = lines.next()) {
        if (!rows) {
            auto header = parse_header(*line, measure, columns);
            if (!header) return lines.fail(header.error().message);
            const bool is_header = header->has_value();
            rows.emplace(measure, *std::move(header));
            if (is_header) continue;
        }
        if (rows->is_full()) return lines.fail(too_many_values);
        if (const auto added = rows->add(*line); !added) return lines.fail(added.error().message);
    }
    auto found = rows ? rows->finished() : std::nullopt;
    if (!found) {
        return lines.fail(fmt::format("the file ends without a {}", wanted(measure).what));
    }
    return *std::move(found);
}

} // namespace hapnet::emulator
