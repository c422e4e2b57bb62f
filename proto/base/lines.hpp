// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/cells.hpp"
#include "proto/base/reading.hpp"
#include "proto/base/result.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace hapnet::base {

/// Returns the text of a file of measured values. UTF-16 with a byte order mark, as PowerShell
/// writes it, becomes UTF-8; other text is unchanged. The error for a compressed file says how to
/// unpack it.
[[nodiscard]] Result<std::string> plain_text(std::string bytes);

/// Returns the content of a file of measured values that another text names. The error names the
/// file.
[[nodiscard]] Result<std::string> open_measured(const Reading& reading, const std::string& file);

/// Reads the lines of a text, without blanks at their ends. Skips empty lines, lines that begin
/// with '#', and a byte order mark.
class LineReader {
public:
    explicit LineReader(std::string_view text);

    /// Returns the next line; nullopt at the end.
    [[nodiscard]] std::optional<std::string_view> next();

    /// Returns the cells of the next line; nullopt at the end. They stay valid until `cells` takes
    /// another line. The error names the line.
    [[nodiscard]] Result<std::optional<std::span<const std::string_view>>> next_cells(Cells& cells);

    /// Returns the number of the line that was returned last, from 1.
    [[nodiscard]] std::size_t number() const;

    /// Returns the number of empty lines that were skipped before the line that was returned last.
    [[nodiscard]] std::size_t skipped_empty() const { return skipped_empty_; }

    /// Returns an error at the line that was returned last, or at the last line of the text.
    [[nodiscard]] tl::unexpected<Error> fail(std::string_view why) const;

private:
    [[nodiscard]] bool find_next();

    std::string_view rest_;
    std::size_t number_ = 0; // last text line of the last result
    std::size_t begun_ = 0;  // first text line of that result: cells may contain line ends
    std::size_t skipped_empty_ = 0;
};

/// Returns the number, from 1, of the line that holds the byte at `place`; the last line's for a
/// place behind the end.
[[nodiscard]] std::size_t line_number_at(std::string_view text, std::size_t place);

/// Returns the text without the blanks at its ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// Shortens a text for messages to at most 40 bytes. The result is safe to print on a terminal.
[[nodiscard]] std::string shortened(std::string_view text);

} // namespace hapnet::base
