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

/// The environment variable for the folder, such as that of the control socket, that the holder of
/// the lifeline has made for this program. If the lifeline hangs up, the program removes the folder
/// at its end, provided that it is empty.
inline constexpr const char* lifeline_folder_variable = "HAPNET_LIFELINE_FOLDER";

/// The meaning of SIGHUP: the terminal has gone, or a file is to be read again.
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

    /// True once a signal that means stop has come; stays true. May be called from any thread: each
    /// thread learns of the signal independently. Never blocks.
    [[nodiscard]] bool requested() const;

    /// Returns the time since a stop was requested; 0: no stop was requested.
    [[nodiscard]] base::Duration requested_for() const;

    /// The signal that asked first: SIGINT, SIGTERM or SIGHUP; SIGTERM when request() did, and
    /// before any.
    [[nodiscard]] int number() const;

    /// True if a key of the terminal, or its hangup, sent the signal to all programs of the
    /// terminal's group.
    [[nodiscard]] bool came_to_group() const;

    /// Requests a stop as if a signal had come. May be called from any thread.
    void request() const;

    /// True if a signal that means reload has come since the last call.
    [[nodiscard]] bool reload_requested() const;

    /// Enforces stops from now on. A process that still runs `patience` after a stop was asked for
    /// ends by _exit(code), whatever blocks it. A terminal at a standard descriptor that hangs up
    /// asks for a stop, too. A thread that writes nothing does both.
    void enforce(base::Duration patience, int code) const;

private:
    struct State;
    std::shared_ptr<State> state_;
};

} // namespace hapnet::net
