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

/// The way in which the cells of a table are written in a line.
struct CellStyle {
    char separator = ',';      // ' ' stands for any number of blanks and tabs
    bool trims_blanks = false; // drops blanks around each cell; separator ' ' always does
};

/// Splits a text into lines of cells (RFC 4180). A cell in quotes may contain separators, line ends
/// and doubled quotes.
class Cells {
public:
    explicit Cells(CellStyle style) : style_{style} {}

    /// Takes the first line off a text, which must not be empty. Returns false when a quote is not
    /// closed or stands inside an unquoted cell. The text cannot be read further then.
    [[nodiscard]] bool take_line(std::string_view& text);

    /// Returns the cells of the line that was taken last. They are valid until the next
    /// take_line().
    [[nodiscard]] std::span<const std::string_view> all() const { return cells_; }

    /// Returns the number of text lines that the last line of cells takes up. It can be more than
    /// one, because cells in quotes may contain line ends.
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
