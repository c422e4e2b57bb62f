// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/rows.hpp"

#include "emulator/core/delay/bounds.hpp"
#include "emulator/core/delay/table.hpp"
#include "proto/base/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <spdlog/fmt/fmt.h>

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

/// A column of durations that are written without their unit.
struct DurationColumn {
    std::string name;
    std::size_t place = 0;
    double nanoseconds = 0.0; // of 1
};

struct Header {
    std::size_t cells = 0;
    DurationColumn delay;
    std::optional<DurationColumn> time;
};

/// The column "<what>_<unit>", if there is one.
base::Result<std::optional<DurationColumn>> find_column(const std::vector<std::string_view>& cells,
                                                        std::string_view what)
{
    struct Unit {
        std::string_view name;
        double nanoseconds;
    };
    constexpr std::array<Unit, 4> units{{{"ns", 1.0}, {"us", 1e3}, {"ms", 1e6}, {"s", 1e9}}};
    std::optional<DurationColumn> found;
    for (std::size_t place = 0; place < cells.size(); ++place) {
        for (const Unit& unit : units) {
            const auto name = fmt::format("{}_{}", what, unit.name);
            if (cells[place] != name) continue;
            if (found) return base::fail(fmt::format("two columns of {}", what));
            found = DurationColumn{name, place, unit.nanoseconds};
        }
    }
    return found;
}

/// The header that a line is; nullopt when the line is a delay.
base::Result<std::optional<Header>> parse_header(std::string_view line)
{
    const auto cells = cells_of(line);
    const auto delay = find_column(cells, "delay");
    if (!delay) return base::fail(delay.error().message);
    if (!*delay) {
        if (cells.size() == 1) return std::nullopt;
        return base::fail("no column is named delay_ns, delay_us, delay_ms or delay_s");
    }
    const auto time = find_column(cells, "time");
    if (!time) return base::fail(time.error().message);
    return Header{cells.size(), **delay, *time};
}

base::Result<base::Duration> parse_cell(std::string_view cell, const DurationColumn& column)
{
    double count = 0.0;
    const auto [end, error] = std::from_chars(cell.begin(), cell.end(), count);
    if (error != std::errc{} || end != cell.end() || !std::isfinite(count)) {
        return base::fail(fmt::format("{} '{}' is not a number", column.name, shortened(cell)));
    }
    if (count < 0.0) return base::fail(fmt::format("{} {} is negative", column.name, count));
    const double nanoseconds = count * column.nanoseconds;
    if (nanoseconds > static_cast<double>(longest_delay.count())) {
        return base::fail(fmt::format("{} {} is longer than 10^6 s", column.name, count));
    }
    return base::Duration{std::llround(nanoseconds)};
}

/// Adds what a line of CSV says.
std::optional<base::Error> add_row(DelayRows& rows, const Header& header, std::string_view line)
{
    const auto cells = cells_of(line);
    if (cells.size() != header.cells) {
        return base::Error{
            fmt::format("{} cells where the header has {}", cells.size(), header.cells)};
    }
    const auto delay = parse_cell(cells[header.delay.place], header.delay);
    if (!delay) return delay.error();
    rows.delays.push_back(*delay);
    if (!header.time) return std::nullopt;
    const auto time = parse_cell(cells[header.time->place], *header.time);
    if (!time) return time.error();
    if (rows.times.empty() && *time != base::Duration{0}) {
        return base::Error{"the first time must be 0"};
    }
    if (!rows.times.empty() && *time <= rows.times.back()) {
        return base::Error{fmt::format("{} is not later than {}", base::to_text(*time),
                                       base::to_text(rows.times.back()))};
    }
    rows.times.push_back(*time);
    return std::nullopt;
}

std::optional<base::Error> add_delay(DelayRows& rows, std::string_view line)
{
    const auto delay = base::parse_duration(line);
    if (delay) {
        rows.delays.push_back(*delay);
        return std::nullopt;
    }
    const auto text = shortened(line);
    if (text.find_first_not_of("0123456789.") == std::string::npos) {
        return base::Error{fmt::format("'{}' has no unit: write {}ms", text, text)};
    }
    if (text != line) return base::Error{fmt::format("'{}' is not a duration", text)};
    return delay.error();
}

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

base::Result<DelayRows> read_delay_rows(std::string_view text)
{
    DelayRows rows;
    std::optional<Header> header;
    bool is_first = true;
    LineReader lines{text};
    while (const auto line = lines.next()) {
        if (is_first) {
            is_first = false;
            auto found = parse_header(*line);
            if (!found) return lines.fail(found.error().message);
            header = *found;
            if (header) continue;
        }
        if (rows.delays.size() == QuantileTable::values_max) return lines.fail(too_many_values);
        const auto error = header ? add_row(rows, *header, *line) : add_delay(rows, *line);
        if (error) return lines.fail(error->message);
    }
    if (rows.delays.empty()) return lines.fail("the file ends without a delay");
    return rows;
}

} // namespace hapnet::emulator
