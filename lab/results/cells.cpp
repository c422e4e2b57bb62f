// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/cells.hpp"

#include <algorithm>
#include <cmath>
#include <spdlog/fmt/fmt.h>
#include <vector>

namespace hapnet::lab {

namespace {

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

std::string milli_cell(std::optional<double> value)
{
    return value && std::isfinite(*value) ? fmt::format("{:.3f}", 1e3 * *value) : "";
}

std::string number_cell(std::optional<double> value)
{
    return value && std::isfinite(*value) ? fmt::format("{:.4f}", *value) : "";
}

std::string quoted_cell(std::string_view text)
{
    std::string cell = "\"";
    for (const char c : text) {
        if (c == '"') cell += '"';
        cell += c;
    }
    return cell + '"';
}

std::string text_cell(std::string_view text)
{
    const bool is_plain = text.find_first_of(",\"\r\n") == std::string_view::npos;
    return is_plain ? std::string{text} : quoted_cell(text);
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

} // namespace hapnet::lab
