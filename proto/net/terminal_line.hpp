// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace hapnet::net {

/// The line at the bottom of a terminal that is written again and again, among other text. It
/// writes nothing itself, but returns the bytes to be written.
class TerminalLine {
public:
    /// `descriptor`, which stays the caller's, is asked whether it is a terminal, and how wide.
    explicit TerminalLine(int descriptor);

    [[nodiscard]] bool is_terminal() const { return is_terminal_; }

    /// Shows `text` instead of the line that stands there, cut to the width of the terminal: a line
    /// that is folded cannot be written over.
    [[nodiscard]] std::string shown(std::string_view text);

    /// Returns the bytes to write before other text: they remove the line, if there is one.
    [[nodiscard]] std::string room();

    /// Leaves the line as it is, if there is one, and begins a new one.
    [[nodiscard]] std::string left();

private:
    int descriptor_;
    bool is_terminal_;
    bool is_open_ = false;
};

} // namespace hapnet::net
