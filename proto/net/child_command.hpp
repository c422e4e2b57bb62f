// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace hapnet::net {

/// A command in a child process, with all processes that it starts. They are descendants of a
/// process of this program, the init of the command. None of them outlives this object or this
/// program, whatever ends it:
///
/// - A command with its own network has its own PID namespace, in which the init is process 1. The
///   kernel kills all processes in it when the init ends.
/// - If the system refuses that, and for other commands, the init is a subreaper
///   (PR_SET_CHILD_SUBREAPER). It kills its descendants when this program has ended.
class ChildCommand {
public:
    struct Setup {
        std::vector<std::string> words; // the command and its arguments
        /// Runs the command in its own network namespace and, if the system permits it, in its own
        /// PID namespace with a matching /proc.
        bool has_own_network = false;
        bool has_own_group = false;             // own process group, and /dev/null as stdin
        int output = -1;                        // stdout and stderr; -1: those of this process
        std::vector<std::string> environment{}; // "NAME=value", added to those of this process
        std::string hosts{};                    // lines added to its /etc/hosts
        std::string name_servers{};             // text of its /etc/resolv.conf; "": unchanged
        /// Runs in the command's network when prepare() is called, before the command runs. Throws
        /// std::system_error.
        std::function<void()> prepare{};
    };

    /// Starts the init, which waits for prepare() and go(). The process must have only one thread.
    /// Throws std::system_error if the system refuses what the setup requires.
    explicit ChildCommand(const Setup& setup);
    /// Kills the command and all processes that it has started, and waits for their end.
    ~ChildCommand();
    ChildCommand(const ChildCommand&) = delete;
    ChildCommand& operator=(const ChildCommand&) = delete;

    /// Runs Setup::prepare in the command's network, and returns when it is done. Throws the
    /// exception that it failed with.
    void prepare();
    /// Runs the command. Throws std::system_error if there is no such command.
    void go();

    /// Returns the process id of the init, which is in the network of the command as long as this
    /// object lives.
    [[nodiscard]] pid_t pid() const { return pid_; }
    /// Readable or hung up once the command has ended.
    [[nodiscard]] int descriptor() const { return ended_; }
    /// Returns the exit code of the command, or 128 + n if signal n killed it; nullopt while it
    /// runs. Its background processes may still run afterwards.
    [[nodiscard]] std::optional<int> exit_code();
    /// Sends a signal to the command, and to its process group if it has its own. Does nothing
    /// after the command has ended.
    void signal(int number);

private:
    bool start(const Setup& setup, bool has_own_processes);
    bool await_report();
    void give_terminal_back() const;

    pid_t pid_ = -1;
    int init_ = -1;     // socket: orders to the init, and its report of each step
    int ended_ = -1;    // pipe from the init: the exit code of the command
    int terminal_ = -1; // terminal of this process group when the command started; -1: none
    bool has_own_processes_ = false;
    std::optional<int> exit_code_;
};

} // namespace hapnet::net
