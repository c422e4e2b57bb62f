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

/// The text of a file of measured values. UTF-16 with a byte order mark, as PowerShell writes it,
/// becomes UTF-8; other text stays as it is. The error says how to unpack a compressed file.
[[nodiscard]] Result<std::string> plain_text(std::string bytes);

/// The text of a file of measured values that another text names. The error names the file.
[[nodiscard]] Result<std::string> open_measured(const Reading& reading, const std::string& file);

/// The lines of a text that say something: without the blanks around them, empty lines and those
/// that begin with '#'. A byte order mark is skipped.
class LineReader {
public:
    explicit LineReader(std::string_view text);

    /// Returns the next line; nullopt at the end.
    [[nodiscard]] std::optional<std::string_view> next();

    /// The cells of the next line, which stay valid as `cells` says; nullopt at the end. The error
    /// names the line.
    [[nodiscard]] Result<std::optional<std::span<const std::string_view>>> next_cells(Cells& cells);

    /// The number of the line that was given last, from 1.
    [[nodiscard]] std::size_t number() const;

    /// The number of empty lines that were skipped before the line that was given last.
    [[nodiscard]] std::size_t skipped_empty() const { return skipped_empty_; }

    /// An error at the line that was given last, or at the last one of the text.
    [[nodiscard]] tl::unexpected<Error> fail(std::string_view why) const;

private:
    [[nodiscard]] bool find_next();

    std::string_view rest_;
    std::size_t number_ = 0; // last line of the result that was given last
    std::size_t begun_ = 0;  // first line of that result: cells may hold ends of lines
    std::size_t skipped_empty_ = 0;
};

/// The text without the blanks around it.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// Shortens a text for messages: at most 40 bytes of it, as a terminal may show them.
[[nodiscard]] std::string shortened(std::string_view text);

} // namespace hapnet::base
