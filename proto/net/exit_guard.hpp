// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace hapnet::net {

/// Catches exit() and quick_exit() as long as it lives. Such a call comes from code that the
/// program has loaded, such as an algorithm in C. The guard then has the force ended as in a crash
/// (CrashSignal), names the file of that code on stderr, and ends the program with exit_failed.
/// Construct at most one. _exit(), execve() and SIGKILL cannot be caught.
class ExitGuard {
public:
    /// The name of the program, for the message.
    explicit ExitGuard(std::string_view program);
    ~ExitGuard();
    ExitGuard(const ExitGuard&) = delete;
    ExitGuard& operator=(const ExitGuard&) = delete;

    [[nodiscard]] const std::string& program() const { return program_; }

private:
    std::string program_;
};

} // namespace hapnet::net
