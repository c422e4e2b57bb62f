// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/frame_session.hpp"
#include "proto/base/time.hpp"
#include "proto/net/child_command.hpp"
#include "proto/net/command_start.hpp"
#include "proto/net/stop_signal.hpp"

#include <optional>
#include <string>
#include <vector>

namespace hapnet::emulator {

/// Runs command A and the other processes that it communicates with, beside the rounds of a
/// session. It lasts from the start of all of them until all have ended.
class CommandRun {
public:
    /// A process at another end of the wire.
    struct Other {
        net::ChildCommand& process;
        std::string name; // "command B"
        /// False for a process that has to be started. A then waits until that process listens on a
        /// port, 1 s at most.
        bool runs_already = false;
    };

    CommandRun(net::ChildCommand& a, const std::vector<Other>& others, FrameSession& session,
               const net::StopSignal& stop);

    /// Returns the exit code of A.
    int run();

private:
    /// Ends a process.
    class Ending {
    public:
        explicit Ending(net::ChildCommand& process) : process_{process} {}
        /// Sends signal `number` to the process at the first call. Later calls send SIGTERM once 2
        /// s have passed since the first call, and SIGKILL once 3 s have passed. `number` 0: the
        /// process has received its signal already, so none is sent at the first call.
        void pursue(int number, base::TimePoint now);
        [[nodiscard]] bool is_over() { return process_.exit_code().has_value(); }

    private:
        net::ChildCommand& process_;
        std::optional<base::TimePoint> told_;
        bool is_told_again_ = false;
    };

    /// One of the other processes.
    struct Watched {
        Other other;
        Ending end;
        bool has_told = false; // its end was reported
    };

    [[nodiscard]] bool is_over();
    [[nodiscard]] bool is_told() const;
    [[nodiscard]] std::vector<int> descriptors();
    void look_after(base::TimePoint now);
    [[nodiscard]] bool has_a_started();
    void tell_of_ended(Watched& one);
    void end_all(base::TimePoint now);

    net::ChildCommand& a_;
    std::vector<Watched> others_;
    FrameSession& session_;
    const net::StopSignal& stop_;
    Ending end_of_a_;
    net::CommandStart start_;
    std::optional<base::TimePoint> next_look_;
    bool has_a_started_ = false;
    bool is_ending_ = false;
};

} // namespace hapnet::emulator
