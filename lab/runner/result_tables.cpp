// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/runner/result_tables.hpp"

#include "proto/base/csv.hpp"
#include "proto/base/ensure.hpp"
#include "proto/disk/result_file.hpp"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <spdlog/fmt/fmt.h>
#include <system_error>

namespace hapnet::lab::runner {

namespace {

[[noreturn]] void refuse_part(const std::filesystem::path& path)
{
    throw std::system_error{errno, std::generic_category(), "cannot write " + path.string()};
}

} // namespace

ResultTables::~ResultTables()
{
    std::error_code ignored;
    for (const Table& table : tables_) std::filesystem::remove(waiting(table), ignored);
}

void ResultTables::add(const results::File& csv, std::span<const LeadingCell> leading)
{
    const auto parsed = base::parse_csv(csv.text, csv.path);
    base::ensure(parsed.has_value());
    Table& table = table_named(csv.path);
    const auto place_of = [&](const std::string& column) {
        const auto known = std::ranges::find(table.columns, column);
        const auto place = static_cast<std::size_t>(known - table.columns.begin());
        if (known == table.columns.end()) table.columns.push_back(column);
        return place;
    };
    std::vector<std::size_t> leading_places, places;
    for (const LeadingCell& cell : leading) leading_places.push_back(place_of(cell.column));
    for (const std::string& column : parsed->columns) places.push_back(place_of(column));
    const auto width = table.columns.size();
    if (table.widths.empty() || table.widths.back().second != width)
        table.widths.emplace_back(table.lines, width);

    std::string text;
    std::vector<std::string> cells;
    for (const base::CsvTable::Line& line : parsed->lines) {
        cells.assign(width, "");
        for (std::size_t i = 0; i < leading.size(); ++i)
            cells[leading_places[i]] = base::csv_quoted(leading[i].value);
        for (std::size_t i = 0; i < places.size(); ++i)
            cells[places[i]] = base::csv_quoted(line.cells[i]);
        text += fmt::format("{}\n", fmt::join(cells, ","));
        ++table.lines;
    }
    std::ofstream out{waiting(table), std::ios::app | std::ios::binary};
    if (!(out << text << std::flush)) refuse_part(waiting(table));
}

std::vector<std::string> ResultTables::commit()
{
    constexpr std::size_t block = 1 << 20;
    std::vector<std::string> names;
    for (const Table& table : tables_) {
        disk::ResultFile file{(folder_ / table.name).string()};
        std::string text = fmt::format("{}\n", fmt::join(table.columns, ","));
        std::ifstream in{waiting(table), std::ios::binary};
        auto width = table.widths.begin();
        std::string line;
        for (std::size_t number = 0; number < table.lines; ++number) {
            if (!std::getline(in, line)) refuse_part(waiting(table));
            if (width + 1 != table.widths.end() && number == (width + 1)->first) ++width;
            text += line + std::string(table.columns.size() - width->second, ',') + '\n';
            if (text.size() < block) continue;
            file.append(text);
            text.clear();
        }
        file.commit(text);
        names.push_back(table.name);
    }
    return names;
}

ResultTables::Table& ResultTables::table_named(const std::string& name)
{
    const auto known = std::ranges::find(tables_, name, &Table::name);
    if (known != tables_.end()) return *known;
    Table& table = tables_.emplace_back(Table{.name = name});
    std::filesystem::remove(waiting(table)); // of a run that was killed
    return table;
}

std::filesystem::path ResultTables::waiting(const Table& table) const
{
    return folder_ / (table.name + ".part");
}

} // namespace hapnet::lab::runner
