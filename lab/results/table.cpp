// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/table.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <array>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::results {

namespace {

/// The endings of keys and their units. Of two that match the first counts.
constexpr std::array<std::pair<std::string_view, std::string_view>, 8> units{{{"_of_100", "of 100"},
                                                                              {"_percent", "%"},
                                                                              {"_mm", "mm"},
                                                                              {"_ms", "ms"},
                                                                              {"_mj", "mJ"},
                                                                              {"_deg", "deg"},
                                                                              {"_n", "N"},
                                                                              {"_s", "s"}}};

const std::pair<std::string_view, std::string_view>* end_of(std::string_view key)
{
    const auto* const found =
        std::ranges::find_if(units, [&](const auto& unit) { return key.ends_with(unit.first); });
    return found == units.end() ? nullptr : found;
}

bool is_filled(const Table& table, std::size_t column)
{
    return std::ranges::any_of(table.rows, [&](const std::vector<Cell>& row) {
        return !std::holds_alternative<std::monostate>(row[column]);
    });
}

/// Returns the cell of a field's value.
Cell cell_of_field(const base::FieldRow& row, const void* owner)
{
    const void* value = row.in(owner);
    if (row.kind->shape == base::ValueKind::Shape::maybe) {
        if (row.kind->size(value) == 0) return {};
        value = row.kind->element_at(value, 0);
    }
    return std::visit([](const auto& leaf) { return to_cell(leaf); }, row.kind->plain().get(value));
}

} // namespace

std::vector<Column> columns_in(std::string_view line)
{
    std::vector<Column> columns;
    while (!line.empty()) {
        std::string_view word = line.substr(0, line.find(','));
        line.remove_prefix(std::min(word.size() + 1, line.size()));
        Column& column = columns.emplace_back();
        if (word.ends_with('?')) column.stands = Stands::if_filled;
        if (word.ends_with('+')) column.stands = Stands::in_json;
        if (column.stands != Stands::always) word.remove_suffix(1);
        if (const auto colon = word.find(':'); colon != std::string_view::npos) {
            column.decimals = word.back() - '0';
            word = word.substr(0, colon);
        }
        column.key = word;
    }
    return columns;
}

std::string_view unit_of(std::string_view key)
{
    const auto* const end = end_of(key);
    return end == nullptr ? std::string_view{} : end->second;
}

std::string label_of(std::string_view key)
{
    if (const auto* const end = end_of(key)) key.remove_suffix(end->first.size());
    std::string words{key};
    std::ranges::replace(words, '_', ' ');
    return words;
}

std::optional<std::size_t> Table::place_of(std::string_view key) const
{
    const auto found = std::ranges::find(columns, key, &Column::key);
    if (found == columns.end()) return std::nullopt;
    return static_cast<std::size_t>(found - columns.begin());
}

const Cell& TableRow::operator[](std::string_view key) const
{
    static const Cell nothing;
    const auto place = table_->place_of(key);
    return place ? (*cells_)[*place] : nothing;
}

std::optional<double> TableRow::number(std::string_view key) const
{
    const Cell& cell = (*this)[key];
    if (const auto* whole = std::get_if<std::uint64_t>(&cell)) return static_cast<double>(*whole);
    const auto* number = std::get_if<double>(&cell);
    return number == nullptr ? std::nullopt : std::optional{*number};
}

std::string TableRow::text(std::string_view key) const { return to_text((*this)[key]); }

Rows rows_of(const Table& table)
{
    Rows rows;
    for (std::size_t i = 0; i < table.rows.size(); ++i) rows.emplace_back(table, i);
    return rows;
}

std::string to_text(const Cell& cell)
{
    if (std::holds_alternative<std::monostate>(cell)) return "";
    if (const auto* text = std::get_if<std::string>(&cell)) return *text;
    if (const auto* flag = std::get_if<bool>(&cell)) return *flag ? "true" : "false";
    if (const auto* whole = std::get_if<std::uint64_t>(&cell)) return fmt::format("{}", *whole);
    return fmt::format("{}", std::get<double>(cell));
}

Table with_leading(const std::vector<LeadingCell>& leading, Table table)
{
    std::vector<Column> columns;
    std::vector<Cell> cells;
    for (const LeadingCell& one : leading) {
        columns.push_back({one.key});
        cells.push_back(one.cell);
    }
    table.columns.insert(table.columns.begin(), columns.begin(), columns.end());
    for (auto& row : table.rows) row.insert(row.begin(), cells.begin(), cells.end());
    return table;
}

void append(Table& table, const Table& part)
{
    // The index of each column in the part and in the table.
    std::vector<std::pair<std::size_t, std::size_t>> places;
    for (std::size_t i = 0; i < part.columns.size(); ++i) {
        const Column& column = part.columns[i];
        const auto known = table.place_of(column.key);
        if (!known && column.stands == Stands::if_filled && !is_filled(part, i)) continue;
        places.emplace_back(i, known.value_or(table.columns.size()));
        if (!known) table.columns.push_back(column);
    }
    for (auto& row : table.rows) row.resize(table.columns.size());
    for (const auto& row : part.rows) {
        base::ensure(row.size() == part.columns.size());
        auto& own = table.rows.emplace_back(table.columns.size());
        for (const auto& [from, to] : places) own[to] = row[from];
    }
}

Table filled(const Table& table)
{
    Table whole{table.name, {}};
    append(whole, table);
    return whole;
}

Table table_of(std::string name, const base::FieldTable& fields,
               std::span<const void* const> values)
{
    Table table{std::move(name), {}};
    for (const base::FieldRow& row : fields.rows)
        table.columns.push_back({std::string{row.key}, row.decimals,
                                 row.is_spare ? Stands::if_filled : Stands::always});
    for (const void* value : values) {
        auto& cells = table.rows.emplace_back();
        for (const base::FieldRow& row : fields.rows) cells.push_back(cell_of_field(row, value));
    }
    return table;
}

} // namespace hapnet::lab::results
