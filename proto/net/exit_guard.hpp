// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace hapnet::net {

/// While it lives, the program does not end by exit() or quick_exit(): that is a call by code that
/// it has loaded, such as an algorithm in C. The guard then has the force ended as at a crash
/// (CrashSignal), names the file of that code on stderr, and ends the program with exit_failed.
/// Construct at most one. Nothing catches _exit(), execve() and SIGKILL.
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
