// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/net/child_command.hpp"

#include <array>
#include <cstdint>

namespace hapnet::net {

/// One message to the init of a command.
struct InitOrder {
    enum class Kind : std::uint8_t {
        prepare, // answered by a report
        go,      // answered by a report once the command runs
        signal,  // a signal number to pass on to the command
        end      // kill all processes that the command has started, and end
    };
    Kind kind = Kind::end;
    int number = 0;
};

/// A message from the init: a step is done, or the reason why it failed.
struct InitReport {
    enum class Kind : std::uint8_t {
        done,
        refused, // the system permits no PID namespace, or no /proc in it
        failed
    };
    Kind kind = Kind::done;
    int error = 0;
    std::array<char, 512> what{}; // text of the error, with a terminating zero
};

/// The descriptors that the init of a command shares with the program that started it.
struct InitEnds {
    int orders = -1; // socket for InitOrder and InitReport messages
    int ended = -1;  // pipe for the exit code of the command, an int
    int parent = -1; // readable once the program has ended (a pidfd)
};

/// Runs the init of a command, in the process that was created for it. It ends with the program, or
/// on the order `end`. `is_first` is true if the process is process 1 of a PID namespace.
[[noreturn]] void live_as_init(const ChildCommand::Setup& setup, const InitEnds& ends,
                               bool is_first);

} // namespace hapnet::net
