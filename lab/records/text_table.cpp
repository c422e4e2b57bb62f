// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/text_table.hpp"

#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab {

namespace {

constexpr std::size_t name_width = 28;

std::string line(const std::string& name, const std::vector<std::string>& cells, std::size_t width)
{
    std::string text = fmt::format("{:<{}}", name, name_width);
    for (const std::string& cell : cells) text += fmt::format("{:>{}}", cell, width);
    return text;
}

} // namespace

std::string to_text(const TextTable& table)
{
    std::string text = line(table.unit, table.heads, table.cell_width) + '\n';
    for (const TextTable::Row& row : table.rows) {
        text += line(row.name, row.cells, table.cell_width);
        if (!row.note.empty()) text += "   " + row.note;
        text += '\n';
    }
    for (const std::string& remark : table.remarks) text += remark + '\n';
    return text;
}

std::string number_text(std::optional<double> value, int decimals)
{
    return value && std::isfinite(*value) ? fmt::format("{:.{}f}", *value, decimals) : "-";
}

} // namespace hapnet::lab
