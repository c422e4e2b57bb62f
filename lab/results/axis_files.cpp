// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/axis_files.hpp"

#include "proto/base/csv.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::results {

namespace {

/// A table that grows by the tables of further values; a column that one of them lacks is empty.
struct JoinedTable {
    std::string name;
    std::vector<std::string> columns{};
    std::vector<std::vector<std::string>> lines{};

    void add(const base::CsvTable& table, std::string_view parameter, const std::string& value)
    {
        std::vector<std::size_t> places;
        for (const std::string& column : table.columns) {
            const auto known = std::ranges::find(columns, column);
            places.push_back(static_cast<std::size_t>(known - columns.begin()));
            if (known == columns.end()) columns.push_back(column);
        }
        for (const base::CsvTable::Line& line : table.lines) {
            auto& cells = lines.emplace_back(std::vector{std::string{parameter}, value});
            cells.resize(2 + columns.size());
            for (std::size_t i = 0; i < places.size(); ++i) cells[2 + places[i]] = line.cells[i];
        }
    }

    [[nodiscard]] std::string text() const
    {
        std::string out = fmt::format("parameter,value,{}\n", fmt::join(columns, ","));
        for (const auto& cells : lines) {
            std::string line;
            for (std::size_t i = 0; i < 2 + columns.size(); ++i) {
                if (i > 0) line += ',';
                if (i < cells.size()) line += base::csv_quoted(cells[i]);
            }
            out += line + '\n';
        }
        return out;
    }
};

} // namespace

std::vector<File> joined_by_axis(std::string_view parameter, std::span<const AxisFiles> points)
{
    constexpr std::string_view ending = ".csv";
    std::vector<JoinedTable> tables;
    for (const AxisFiles& point : points) {
        for (const File& file : point.files) {
            const bool is_table =
                file.path.ends_with(ending) && file.path.find('/') == std::string::npos;
            if (!is_table) continue;
            const auto name = file.path.substr(0, file.path.size() - ending.size());
            auto table = std::ranges::find(tables, name, &JoinedTable::name);
            if (table == tables.end()) table = tables.insert(table, JoinedTable{name});
            const auto parsed = base::parse_csv(file.text, file.path);
            base::ensure(parsed.has_value());
            table->add(*parsed, parameter, point.value);
        }
    }
    std::vector<File> files;
    for (const JoinedTable& table : tables)
        files.push_back({table.name + "_by_axis.csv", table.text()});
    return files;
}

} // namespace hapnet::lab::results
