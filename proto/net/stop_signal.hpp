// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <cstdint>
#include <memory>

namespace hapnet::net {

/// The name of the environment variable by which a program ties the life of another program to its
/// own. The value is the number of an inherited descriptor: the reading end of a pipe that nothing
/// is written to. Only the starting program has the other end, so the pipe hangs up when that
/// program has ended, whatever ended it.
inline constexpr const char* lifeline_variable = "HAPNET_LIFELINE";

/// The environment variable with the folder that the starting program has created for this program,
/// such as that of the control socket. If the lifeline hangs up, the program removes the folder at
/// its end, provided that it is empty.
inline constexpr const char* lifeline_folder_variable = "HAPNET_LIFELINE_FOLDER";

/// The meaning of SIGHUP: stop because the terminal has gone, or read a file again.
enum class Hangup : std::uint8_t { stop, reload };

/// Makes SIGINT, SIGTERM and SIGHUP something to wait for. Construct one, first in main() and
/// before any thread. From then on these signals interrupt nothing and are read here. SIGPIPE is
/// ignored, because a reader that has left must not end a session. SIGTTIN is ignored, too: a
/// background program that reads its terminal must not be stopped while it exerts a force. The end
/// of the program that holds the lifeline counts as SIGTERM.
class StopSignal {
public:
    explicit StopSignal(Hangup hangup = Hangup::stop);
    ~StopSignal();
    StopSignal(const StopSignal&) = delete;
    StopSignal& operator=(const StopSignal&) = delete;

    /// Readable once a signal has arrived, until one of the functions below is called.
    [[nodiscard]] int descriptor() const;

    /// True once a signal that means stop has arrived; it stays true. May be called from any
    /// thread: each thread learns of the signal independently. Never blocks.
    [[nodiscard]] bool requested() const;

    /// Returns the time since a stop was requested; 0: no stop was requested.
    [[nodiscard]] base::Duration requested_for() const;

    /// Returns the signal that requested the stop first: SIGINT, SIGTERM or SIGHUP. It is SIGTERM
    /// after request(), and before any stop.
    [[nodiscard]] int number() const;

    /// True if the terminal sent the signal to its whole process group, because of a key or because
    /// it hung up.
    [[nodiscard]] bool came_to_group() const;

    /// Requests a stop as if a signal had come. May be called from any thread.
    void request() const;

    /// True if a signal that means reload has arrived since the last call.
    [[nodiscard]] bool reload_requested() const;

    /// Enforces stops from now on. A process that still runs `patience` after a stop was requested
    /// ends by _exit(code), whatever blocks it. The hangup of a terminal at a standard descriptor
    /// also requests a stop. A thread that writes nothing does both.
    void enforce(base::Duration patience, int code) const;

private:
    struct State;
    std::shared_ptr<State> state_;
};

} // namespace hapnet::net
