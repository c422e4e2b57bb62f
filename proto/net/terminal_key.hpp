// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

namespace hapnet::net {

/// The Enter key of the terminal at stdin, for a program that reads nothing else from it. There is
/// no key if stdin is a file or a pipe, or while the program is in the background.
class TerminalKey {
public:
    explicit TerminalKey(int descriptor = 0);

    /// True if the key was pressed since the last call. Never blocks.
    [[nodiscard]] bool was_pressed() const;

private:
    int descriptor_; // -1: no terminal
};

} // namespace hapnet::net
