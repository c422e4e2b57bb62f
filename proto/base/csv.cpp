// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/csv.hpp"

#include "proto/base/cells.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <utility>
#include <variant>

namespace hapnet::base {

namespace {

tl::unexpected<Error> fail_at(const std::string& path, std::size_t line, const std::string& what)
{
    return fail(fmt::format("{}:{}: {}", path, line, what));
}

using Shape = ValueKind::Shape;

/// The format of numbers in the cells of a column.
struct CellScale {
    std::optional<int> decimals{};
    std::optional<double> ns_per_unit{}; // for times
};

/// Returns the text of a value.
std::string cell_text(const ValueKind& kind, const void* value, const CellScale& scale)
{
    if (kind.shape == Shape::maybe) {
        if (kind.size(value) == 0) return "";
        return cell_text(*kind.element, kind.element_at(value, 0), scale);
    }
    ensure(kind.get != nullptr);
    const auto& decimals = scale.decimals;
    Leaf leaf = kind.get(value);
    if (kind.shape == Shape::time) {
        ensure(scale.ns_per_unit.has_value()); // the column names its unit
        leaf = static_cast<double>(std::get<std::int64_t>(leaf)) / *scale.ns_per_unit;
    }
    if (const auto* number = std::get_if<double>(&leaf)) {
        if (!std::isfinite(*number)) return "";
        return decimals ? fmt::format("{:.{}f}", *number, *decimals) : fmt::format("{}", *number);
    }
    if (const auto* text = std::get_if<std::string>(&leaf)) return csv_quoted(*text);
    return std::visit([](const auto& own) { return fmt::format("{}", own); }, leaf);
}

template <typename T>
std::optional<Leaf> number_in(std::string_view cell)
{
    T value{};
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc{} || end != cell.data() + cell.size()) return std::nullopt;
    return Leaf{value};
}

/// Returns the value of a cell; nullopt: the cell has no value of that shape.
std::optional<Leaf> leaf_in(std::string_view cell, Shape shape)
{
    switch (shape) {
    case Shape::flag:
        if (cell != "true" && cell != "false") return std::nullopt;
        return Leaf{cell == "true"};
    case Shape::whole:
        return cell.starts_with('-') ? number_in<std::int64_t>(cell)
                                     : number_in<std::uint64_t>(cell);
    case Shape::number: {
        auto number = number_in<double>(cell);
        if (number && !std::isfinite(std::get<double>(*number))) return std::nullopt;
        return number;
    }
    default: return Leaf{std::string{cell}};
    }
}

/// Returns the rows that become columns of a table of these values.
std::vector<const FieldRow*> columns_for(const FieldTable& fields,
                                         std::span<const void* const> values)
{
    std::vector<const FieldRow*> columns;
    for (const FieldRow& row : fields.rows) {
        const auto fills = [&](const void* value) {
            bool is_filled = false;
            row.look(value, [&](const void* cell) { is_filled = row.kind->size(cell) > 0; });
            return is_filled;
        };
        if (!row.is_spare || std::ranges::any_of(values, fills)) columns.push_back(&row);
    }
    return columns;
}

/// Joins the texts that text(row) returns with commas.
template <typename TextOf>
std::string with_commas(std::span<const FieldRow* const> columns, const TextOf& text)
{
    std::string line;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        if (i > 0) line += ',';
        line += text(*columns[i]);
    }
    return line;
}

std::vector<const FieldRow*> all_columns(const FieldTable& fields)
{
    std::vector<const FieldRow*> columns;
    for (const FieldRow& row : fields.rows) columns.push_back(&row);
    return columns;
}

std::string header_of(std::span<const FieldRow* const> columns)
{
    return with_commas(columns, [](const FieldRow& row) { return row.key; });
}

std::string line_of(std::span<const FieldRow* const> columns, const void* value)
{
    return with_commas(columns, [&](const FieldRow& row) {
        const auto decimals = row.decimals ? row.decimals : row.telling.decimals;
        std::string text;
        row.look(value, [&](const void* cell) {
            text = cell_text(*row.kind, cell, {decimals, time_unit_of(row.key)});
        });
        return text;
    });
}

} // namespace

Result<CsvTable> parse_csv(std::string_view text, const std::string& path)
{
    CsvTable table{path, {}, {}};
    Cells cells{{}};
    for (std::size_t number = 1; !text.empty(); number += cells.lines()) {
        if (text == "\n" || text == "\r\n" || text == "\r") break;
        if (!cells.take_line(text)) {
            return fail_at(path, number, "a quote is open or stands inside a cell");
        }
        std::vector<std::string> line{cells.all().begin(), cells.all().end()};
        if (table.columns.empty()) {
            table.columns = std::move(line);
            continue;
        }
        if (line.size() != table.columns.size()) {
            return fail_at(path, number,
                           fmt::format("expected {} cells as in the header, found {}",
                                       table.columns.size(), line.size()));
        }
        table.lines.push_back({number, std::move(line)});
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

std::string cell_of(const ValueKind& kind, const void* value) { return cell_text(kind, value, {}); }

bool read_cell(const ValueKind& kind, std::string_view cell, void* value)
{
    if (kind.shape == Shape::maybe) {
        kind.clear(value);
        return cell.empty() || read_cell(*kind.element, cell, kind.add(value));
    }
    ensure(kind.set != nullptr);
    const auto leaf = leaf_in(cell, kind.shape);
    return leaf && kind.set(value, *leaf);
}

std::string csv_header(const FieldTable& fields) { return header_of(all_columns(fields)); }

std::string csv_line(const FieldTable& fields, const void* value)
{
    return line_of(all_columns(fields), value);
}

std::string csv_text(const FieldTable& fields, std::span<const void* const> values)
{
    const auto columns = columns_for(fields, values);
    std::string text = header_of(columns) + '\n';
    for (const void* value : values) text += line_of(columns, value) + '\n';
    return text;
}

} // namespace hapnet::base
