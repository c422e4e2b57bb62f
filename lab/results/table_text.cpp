// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/table_text.hpp"

#include "proto/base/csv.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::results {

namespace {

using Json = nlohmann::ordered_json;

constexpr int tables_version = 1;

std::string json_of(std::string_view text)
{
    return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string csv_cell(const Column& column, const Cell& cell)
{
    const auto* number = std::get_if<double>(&cell);
    if (number != nullptr && column.decimals)
        return fmt::format("{:.{}f}", *number, *column.decimals);
    return base::csv_quoted(to_text(cell));
}

std::string json_cell(const Cell& cell)
{
    if (std::holds_alternative<std::monostate>(cell)) return "null";
    if (const auto* text = std::get_if<std::string>(&cell)) return json_of(*text);
    return to_text(cell);
}

/// Returns the texts of a row's cells by `text_of`, with commas between them.
template <typename TextOf>
std::string with_commas(const Table& table, std::size_t row, bool of_json, const TextOf& text_of)
{
    std::string line;
    bool is_first = true;
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        if (!of_json && table.columns[i].stands == Stands::in_json) continue;
        if (!std::exchange(is_first, false)) line += ',';
        line += text_of(table.columns[i], table.rows[row][i]);
    }
    return line;
}

std::string json_columns(const std::vector<Column>& columns)
{
    Json list = Json::array();
    for (const Column& column : columns) {
        Json& json = list.emplace_back(Json{
            {"key", column.key}, {"label", label_of(column.key)}, {"unit", unit_of(column.key)}});
        if (column.decimals) json["decimals"] = *column.decimals;
    }
    return list.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Cell cell_of_json(const Json& json)
{
    if (json.is_boolean()) return json.get<bool>();
    if (json.is_number_unsigned()) return json.get<std::uint64_t>();
    if (json.is_number()) return json.get<double>();
    if (json.is_string()) return json.get<std::string>();
    return {};
}

/// Returns the table in a JSON value; nullopt when a row has not as many cells as there are
/// columns. Throws Json::exception where a member is missing or has another type.
std::optional<Table> table_in(const std::string& name, const Json& json)
{
    Table table{name, {}};
    for (const Json& column : json.at("columns")) {
        table.columns.push_back({column.at("key").get<std::string>()});
        if (const auto decimals = column.find("decimals"); decimals != column.end())
            table.columns.back().decimals = decimals->get<int>();
    }
    for (const Json& row : json.at("rows")) {
        auto& cells = table.rows.emplace_back();
        for (const Json& cell : row) cells.push_back(cell_of_json(cell));
        if (cells.size() != table.columns.size()) return std::nullopt;
    }
    return table;
}

} // namespace

std::string csv_header(const std::vector<Column>& columns)
{
    std::string line;
    for (const Column& column : columns) {
        if (column.stands == Stands::in_json) continue;
        line += (line.empty() ? "" : ",") + base::csv_quoted(column.key);
    }
    return line;
}

std::string csv_line(const Table& table, std::size_t row)
{
    return with_commas(table, row, false, csv_cell);
}

std::string json_line(const Table& table, std::size_t row)
{
    return with_commas(table, row, true,
                       [](const Column&, const Cell& cell) { return json_cell(cell); });
}

std::string json_head(const std::string& name, const std::vector<Column>& columns)
{
    return fmt::format("\n{}:{{\"columns\":{},\"rows\":[", json_of(name), json_columns(columns));
}

std::string csv_text(const Table& table)
{
    const Table whole = filled(table);
    std::string text = csv_header(whole.columns) + '\n';
    for (std::size_t row = 0; row < whole.rows.size(); ++row) text += csv_line(whole, row) + '\n';
    return text;
}

std::string json_text(std::span<const Table> tables)
{
    std::string text{json_begin};
    for (const Table& table : tables) {
        const Table whole = filled(table);
        if (&table != tables.data()) text += ',';
        text += json_head(whole.name, whole.columns);
        for (std::size_t row = 0; row < whole.rows.size(); ++row)
            text += fmt::format("{}\n[{}]", row > 0 ? "," : "", json_line(whole, row));
        text += "]}";
    }
    return text += json_end;
}

std::string aligned_text(const Table& table)
{
    const Table whole = filled(table);
    constexpr std::size_t gap = 2;
    std::vector<std::string> lines(whole.rows.size() + 1);
    for (std::size_t i = 0; i < whole.columns.size(); ++i) {
        const Column& column = whole.columns[i];
        if (column.stands == Stands::in_json) continue;
        std::vector<std::string> cells{column.key};
        for (const auto& row : whole.rows) cells.push_back(csv_cell(column, row[i]));
        const auto width = std::ranges::max(cells, {}, &std::string::size).size() + gap;
        for (std::size_t line = 0; line < lines.size(); ++line)
            lines[line] += fmt::format("{:<{}}", cells[line], width);
    }
    std::string text;
    for (std::string& line : lines) {
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + '\n';
    }
    return text;
}

Json json_objects(const Table& table)
{
    Json list = Json::array();
    for (const auto& row : table.rows) {
        Json& object = list.emplace_back(Json::object());
        for (std::size_t i = 0; i < row.size(); ++i)
            object[table.columns[i].key] = Json::parse(json_cell(row[i]));
    }
    return list;
}

base::Result<std::vector<Table>> read_tables(std::string_view text, const std::string& path)
{
    const auto refuse = [&](std::string_view why) {
        return base::fail(
            fmt::format("{}: not what this version of hapnet-lab writes: {}", path, why));
    };
    // Parts that nest deeper than in any file of this program are left out, as they could exhaust
    // the stack.
    constexpr int depth_max = 8;
    const Json json = Json::parse(
        text, [](int depth, Json::parse_event_t, const Json&) { return depth <= depth_max; },
        false);
    if (!json.is_object()) return refuse("it holds no object of JSON");
    if (json.value("version", Json{}) != tables_version)
        return refuse(fmt::format("its version is not {}", tables_version));
    std::vector<Table> tables;
    try {
        for (const auto& [name, members] : json.at("tables").items()) {
            auto table = table_in(name, members);
            if (!table) return refuse("a row of '" + name + "' has not a cell for each column");
            tables.push_back(*std::move(table));
        }
    } catch (const Json::exception&) {
        return refuse("a table lacks its columns or rows");
    }
    return tables;
}

} // namespace hapnet::lab::results
