// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/results/table_text.hpp"
#include "proto/base/csv.hpp"

#include <charconv>
#include <gtest/gtest.h>
#include <string>
#include <string_view>

namespace hapnet::test {

/// Returns the cell that a text of CSV looks like: nothing, a flag, a number or a text.
inline lab::results::Cell cell_from_csv(const std::string& text)
{
    if (text.empty()) return {};
    if (text == "true" || text == "false") return text == "true";
    const auto read = [&](auto value) -> lab::results::Cell {
        const auto end = text.data() + text.size();
        const auto [at, error] = std::from_chars(text.data(), end, value);
        return error == std::errc{} && at == end ? lab::results::Cell{value} : text;
    };
    const auto whole = read(std::uint64_t{});
    return std::holds_alternative<std::uint64_t>(whole) ? whole : read(0.0);
}

inline lab::results::Table table_from_csv(std::string name, std::string_view text)
{
    const auto csv = base::parse_csv(text, name);
    EXPECT_TRUE(csv) << csv.error().message;
    lab::results::Table table{std::move(name), {}};
    if (!csv) return table;
    for (const std::string& column : csv->columns) table.columns.push_back({column});
    for (const auto& line : csv->lines) {
        auto& row = table.rows.emplace_back();
        for (const std::string& cell : line.cells) row.push_back(cell_from_csv(cell));
    }
    return table;
}

} // namespace hapnet::test
