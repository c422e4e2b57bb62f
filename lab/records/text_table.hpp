// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::lab::records {

/// Numbers for people, in rows and columns. A terminal shows them as text, a page as HTML.
struct TextTable {
    struct Row {
        std::string name;
        std::vector<std::string> cells;
        std::string note{}; // text after the last cell
    };

    std::string caption; // heading on a page; a terminal does not show it
    std::string unit;    // heading of the column with the row names; can be empty
    std::vector<std::string> heads;
    std::vector<Row> rows{};
    std::vector<std::string> remarks{}; // lines below the table
    std::size_t cell_width = 10;        // characters per cell in a terminal
};

/// Returns the table as lines of text: names to the left, cells to the right.
[[nodiscard]] std::string to_text(const TextTable& table);

/// Returns a number as a cell, with this number of decimals; "-" when there is no value or it is
/// not finite.
[[nodiscard]] std::string number_text(std::optional<double> value, int decimals);

/// Returns a CSV without quoted cells as a table for people, with columns of equal width.
[[nodiscard]] std::string aligned(std::string_view csv);

} // namespace hapnet::lab::records
