// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace hapnet::net {

/// A command as a child process. Killed with SIGKILL when it goes out of scope; dies with this
/// process, too.
class ChildCommand {
public:
    struct Setup {
        std::vector<std::string> words;         // the command and its arguments
        bool has_own_network = false;           // in a network namespace of its own
        bool has_own_group = false;             // a process group, and /dev/null as its stdin
        int output = -1;                        // its stdout and stderr; -1: those of this process
        std::vector<std::string> environment{}; // "NAME=value", besides the environment of this one
        std::string hosts{};                    // lines that it reads after those of /etc/hosts
        std::string name_servers{};             // the text of its /etc/resolv.conf; "": as it is
        /// What it does in its network once go() says so, before it runs the command. Throws
        /// std::system_error.
        std::function<void()> prepare{};
    };

    /// Starts the process, which waits for go(). Throws std::system_error when it cannot have what
    /// the setup asks for.
    explicit ChildCommand(const Setup& setup);
    ~ChildCommand();
    ChildCommand(const ChildCommand&) = delete;
    ChildCommand& operator=(const ChildCommand&) = delete;

    /// Has it prepare its network; returns when that is done. Throws what it failed of.
    void prepare();
    /// Runs the command. Throws std::system_error when there is no such command.
    void go();

    [[nodiscard]] pid_t pid() const { return pid_; }
    /// Readable once it has ended.
    [[nodiscard]] int descriptor() const { return ended_; }
    /// Its exit code, 128 + n when signal n killed it; nullopt while it runs.
    [[nodiscard]] std::optional<int> exit_code();
    /// To it, and to its group if it has one of its own. Nothing when it has ended.
    void signal(int number);

private:
    [[noreturn]] void be_child(const Setup& setup, int orders, int reports) const;
    void await_report();

    pid_t pid_ = -1;
    int ended_ = -1;   // a pidfd
    int orders_ = -1;  // to the child: a byte for each step
    int reports_ = -1; // from it: a byte when a step is done, or an errno and what failed
    bool has_own_group_ = false;
    std::optional<int> exit_code_;
};

} // namespace hapnet::net
