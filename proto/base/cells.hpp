// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::base {

/// The style of a table's cells in their lines.
struct CellStyle {
    char separator = ',';      // ' ': any number of blanks and tabs
    bool trims_blanks = false; // drops blanks around each cell; always with separator ' '
};

/// Takes lines of cells off a text (RFC 4180). A cell in quotes may hold separators, ends of lines
/// and, doubled, quotes.
class Cells {
public:
    explicit Cells(CellStyle style) : style_{style} {}

    /// Takes the first line off a text that is not empty. False when a quote is open or stands
    /// inside a cell: the text is then of no further use.
    [[nodiscard]] bool take_line(std::string_view& text);

    /// The cells of the line that was taken last, until the next one is.
    [[nodiscard]] std::span<const std::string_view> all() const { return cells_; }

    /// The number of lines of the text that the last line of cells takes: quotes may hold ends.
    [[nodiscard]] std::size_t lines() const { return lines_; }

private:
    [[nodiscard]] bool is_blank(char c) const;
    [[nodiscard]] bool ends_cell(char c) const;
    void skip_blanks(std::string_view& text) const;
    [[nodiscard]] bool take_quoted(std::string_view& text);
    void take_plain(std::string_view& text);

    CellStyle style_;
    std::vector<std::string_view> cells_;
    std::deque<std::string> unescaped_; // cells that had doubled quotes
    std::size_t lines_ = 0;
};

} // namespace hapnet::base
