// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <cstdint>
#include <memory>

namespace hapnet::net {

/// The name of the environment variable by which a program ties another one to its own life. Its
/// value is the number of an inherited descriptor, the reading end of a pipe that nothing is
/// written to. Only the starting program has the other end, so the pipe hangs up when that program
/// has ended, whatever ended it.
inline constexpr const char* lifeline_variable = "HAPNET_LIFELINE";

/// The name of the environment variable for the folder that the holder of the lifeline has made for
/// this program, with its control socket, say. When the lifeline has hung up, nobody is left to
/// remove that folder: the program does so at its end, if the folder is empty then.
inline constexpr const char* lifeline_folder_variable = "HAPNET_LIFELINE_FOLDER";

/// What SIGHUP means: that the terminal has gone, or that a file is to be read again.
enum class Hangup : std::uint8_t { stop, reload };

/// SIGINT, SIGTERM and SIGHUP as something to wait for. Construct one, first thing in main and
/// before any thread: from then on they interrupt nothing and are read here. SIGPIPE is ignored
/// from then on: a reader that has left must not end a session. So is SIGTTIN: a program in the
/// background that looks at its terminal must not be stopped with a force on its motors. The end of
/// the program that holds the lifeline counts as SIGTERM.
class StopSignal {
public:
    explicit StopSignal(Hangup hangup = Hangup::stop);
    ~StopSignal();
    StopSignal(const StopSignal&) = delete;
    StopSignal& operator=(const StopSignal&) = delete;

    /// Readable once a signal has come, until one of the functions below was called.
    [[nodiscard]] int descriptor() const;

    /// Whether one that means stop has come since construction; stays true. From any thread: each
    /// one that asks learns of a signal by itself, whatever the others are doing. Never blocks.
    [[nodiscard]] bool requested() const;

    /// For how long a stop has been asked for; 0: it has not.
    [[nodiscard]] base::Duration requested_for() const;

    /// The signal that asked first: SIGINT, SIGTERM or SIGHUP; SIGTERM when request() did, and
    /// before any.
    [[nodiscard]] int number() const;

    /// Whether a key of the terminal or its hangup sent it: to all programs of its group.
    [[nodiscard]] bool came_to_group() const;

    /// From any thread: as if such a signal had come.
    void request() const;

    /// Whether one that means reload has come since the last call.
    [[nodiscard]] bool reload_requested() const;

    /// From now on, until the process has gone: when it is still there `patience` after a stop was
    /// asked for, it ends by _exit(code), whatever blocks it. And a terminal at one of the standard
    /// descriptors that hangs up asks for a stop. A thread that writes nothing sees to both.
    void enforce(base::Duration patience, int code) const;

private:
    struct State;
    std::shared_ptr<State> state_;
};

} // namespace hapnet::net
