// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace hapnet::net {

/// A status line at the bottom of a terminal that is rewritten among other text. The class writes
/// nothing itself, but returns the bytes to write.
class TerminalLine {
public:
    /// The caller keeps `descriptor`. It is used to find out if there is a terminal, and its width.
    explicit TerminalLine(int descriptor);

    [[nodiscard]] bool is_terminal() const { return is_terminal_; }

    /// Returns the bytes that replace the status line by `text`. The text is cut to the width of
    /// the terminal, because a wrapped line cannot be overwritten.
    [[nodiscard]] std::string shown(std::string_view text);

    /// Returns the bytes that remove the status line, to be written before other text.
    [[nodiscard]] std::string room();

    /// Returns the bytes that leave the status line, if there is one, and begin a new line.
    [[nodiscard]] std::string left();

private:
    int descriptor_;
    bool is_terminal_;
    bool is_open_ = false;
};

} // namespace hapnet::net
