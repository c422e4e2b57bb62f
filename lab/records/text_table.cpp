// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/text_table.hpp"

#include <algorithm>
#include <cmath>
#include <spdlog/fmt/fmt.h>
#include <string_view>

namespace hapnet::lab::records {

namespace {

constexpr std::size_t name_width = 28;

std::string line(const std::string& name, const std::vector<std::string>& cells, std::size_t width)
{
    std::string text = fmt::format("{:<{}}", name, name_width);
    for (const std::string& cell : cells) text += fmt::format("{:>{}}", cell, width);
    return text;
}

std::vector<std::string_view> split_at(std::string_view text, char separator)
{
    std::vector<std::string_view> pieces;
    while (true) {
        const auto piece = text.substr(0, text.find(separator));
        pieces.push_back(piece);
        if (piece.size() == text.size()) return pieces;
        text.remove_prefix(piece.size() + 1);
    }
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

std::string aligned(std::string_view csv)
{
    std::vector<std::vector<std::string_view>> rows;
    std::vector<std::size_t> widths;
    for (const std::string_view line : split_at(csv, '\n')) {
        if (line.empty()) continue;
        rows.push_back(split_at(line, ','));
        widths.resize(std::max(widths.size(), rows.back().size()));
        for (std::size_t i = 0; i < rows.back().size(); ++i) {
            widths[i] = std::max(widths[i], rows.back()[i].size());
        }
    }
    std::string out;
    for (const auto& row : rows) {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i) {
            line += fmt::format("{:<{}}", row[i], widths[i] + 2);
        }
        line.erase(line.find_last_not_of(' ') + 1);
        out += line + '\n';
    }
    return out;
}

} // namespace hapnet::lab::records
