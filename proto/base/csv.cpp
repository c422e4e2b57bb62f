// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/csv.hpp"

namespace hapnet::base {

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

std::optional<std::vector<std::string>> split_cells(std::string_view line)
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

tl::unexpected<Error> fail_at(const std::string& path, std::size_t line, const std::string& what)
{
    return fail(fmt::format("{}:{}: {}", path, line, what));
}

} // namespace

Result<CsvTable> parse_csv(std::string_view text, const std::string& path)
{
    CsvTable table{path, {}, {}};
    std::size_t number = 1, line_breaks = 0;
    for (std::string_view line; !text.empty(); number += line_breaks) {
        take_line(text, line, line_breaks);
        if (line.empty() && text.empty()) break;
        auto cells = split_cells(line);
        if (!cells) return fail_at(path, number, "a quote is open or stands inside a cell");
        if (table.columns.empty()) {
            table.columns = *std::move(cells);
            continue;
        }
        if (cells->size() != table.columns.size()) {
            return fail_at(path, number,
                           fmt::format("expected {} cells as in the header, found {}",
                                       table.columns.size(), cells->size()));
        }
        table.lines.push_back({number, *std::move(cells)});
    }
    if (table.columns.empty()) return fail_at(path, 1, "expected a header line");
    return table;
}

std::string csv_quoted(std::string_view cell)
{
    if (cell.find_first_of(",\"\r\n") == std::string_view::npos) return std::string{cell};
    std::string out = "\"";
    for (const char c : cell) {
        if (c == '"') out += c;
        out += c;
    }
    return out + '"';
}

} // namespace hapnet::base
