// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/table.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::report {

namespace {

/// Takes one line off a text: up to the newline that is in no quotes. Without it in `line`.
void take_line(std::string_view& text, std::string_view& line, std::size_t& line_breaks)
{
    bool is_quoted = false;
    std::size_t end = 0;
    line_breaks = 0;
    for (; end < text.size(); ++end) {
        if (text[end] == '"') is_quoted = !is_quoted;
        if (text[end] != '\n') continue;
        ++line_breaks;
        if (!is_quoted) break;
    }
    line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
}

/// Takes a cell off a line, and the comma behind it; nullopt: its quotes are not in order.
std::optional<std::string> take_cell(std::string_view& line)
{
    std::string cell;
    if (!line.starts_with('"')) {
        const auto end = std::min(line.find(','), line.size());
        cell = line.substr(0, end);
        line.remove_prefix(end);
        return cell;
    }
    for (std::size_t i = 1; i < line.size(); ++i) {
        if (line[i] != '"') {
            cell += line[i];
        } else if (i + 1 < line.size() && line[i + 1] == '"') {
            cell += line[i++];
        } else {
            line.remove_prefix(i + 1);
            return line.empty() || line.front() == ',' ? std::optional{cell} : std::nullopt;
        }
    }
    return std::nullopt;
}

std::optional<std::vector<std::string>> cells_of(std::string_view line)
{
    std::vector<std::string> cells;
    for (;;) {
        auto cell = take_cell(line);
        if (!cell) return std::nullopt;
        cells.push_back(*std::move(cell));
        if (line.empty()) return cells;
        line.remove_prefix(1);
    }
}

tl::unexpected<base::Error> fail_at(const std::string& path, std::size_t line,
                                    const std::string& what)
{
    return base::fail(fmt::format("{}:{}: {}", path, line, what));
}

} // namespace

base::Result<Table> read_table(const File& file)
{
    Table table{file.path, {}, {}};
    std::string_view text = file.text;
    std::size_t number = 1, line_breaks = 0;
    for (std::string_view line; !text.empty(); number += line_breaks) {
        take_line(text, line, line_breaks);
        if (line.empty() && text.empty()) break;
        auto cells = cells_of(line);
        if (!cells) return fail_at(file.path, number, "a quote is open or stands inside a cell");
        if (table.columns.empty()) {
            table.columns = *std::move(cells);
            continue;
        }
        if (cells->size() != table.columns.size()) {
            return fail_at(file.path, number,
                           fmt::format("expected {} cells as in the header, found {}",
                                       table.columns.size(), cells->size()));
        }
        table.lines.push_back({number, *std::move(cells)});
    }
    if (table.columns.empty()) return fail_at(file.path, 1, "expected a header line");
    return table;
}

std::string Row::text(std::string_view column)
{
    const std::string* found = cell(column);
    return found == nullptr ? std::string{} : *found;
}

double Row::number(std::string_view column)
{
    const auto value = number_if_any(column);
    if (!value && !trouble_) expect(column, "a number", "");
    return value.value_or(0.0);
}

std::optional<double> Row::number_if_any(std::string_view column)
{
    const std::string* found = cell(column);
    if (found == nullptr || found->empty()) return std::nullopt;
    double value = 0.0;
    const char* const end = found->data() + found->size();
    const auto [stop, error] = std::from_chars(found->data(), end, value);
    if (error == std::errc{} && stop == end && std::isfinite(value)) return value;
    expect(column, "a number", *found);
    return std::nullopt;
}

bool Row::flag(std::string_view column)
{
    static constexpr std::array<std::pair<std::string_view, bool>, 2> words{
        {{"true", true}, {"false", false}}};
    return one_of<bool>(column, words);
}

const std::string* Row::cell(std::string_view column)
{
    if (trouble_) return nullptr;
    const auto found = std::find(table_.columns.begin(), table_.columns.end(), column);
    if (found != table_.columns.end()) {
        return &line_.cells[static_cast<std::size_t>(found - table_.columns.begin())];
    }
    complain(1, fmt::format("expected a column '{}'", column));
    return nullptr;
}

void Row::expect(std::string_view column, std::string_view what, std::string_view found)
{
    complain(line_.number, fmt::format("{}: expected {}, found '{}'", column, what, found));
}

void Row::complain(std::size_t line, std::string what)
{
    if (!trouble_) trouble_ = fmt::format("{}:{}: {}", table_.path, line, std::move(what));
}

} // namespace hapnet::lab::report
