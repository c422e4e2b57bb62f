// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/net/child_command.hpp"
#include "proto/net/wake_event.hpp"

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <thread>
#include <vector>

namespace hapnet::net {

/// Starts commands on a thread of its own. Starting a program and looking for its
/// listener take milliseconds, in which the thread that relays their frames would be late.
class CommandStart {
public:
    /// A command that starts first.
    struct Before {
        ChildCommand& command;
        /// True once the last command may start, as far as this one is concerned. Called every
        /// 10 ms until then, on the thread of the start.
        std::function<bool()> is_ready;
    };

    /// The last command starts after this time in any case.
    static constexpr base::Duration patience = std::chrono::seconds{1};

    /// Starts all of `before`, in their order, and `last` once each of them is ready, or has ended
    /// and left nothing in the background that may be about to listen.
    /// Until is_done(), only the exit codes of the commands may be asked for elsewhere.
    CommandStart(ChildCommand& last, std::vector<Before> before);
    /// Ends the thread. Does not start what has not started yet.
    ~CommandStart();
    CommandStart(const CommandStart&) = delete;
    CommandStart& operator=(const CommandStart&) = delete;

    /// Starts the last command without waiting any longer.
    void hurry();

    /// Readable once is_done() is worth asking.
    [[nodiscard]] int descriptor() const { return done_.descriptor(); }
    /// True once all commands have started. Throws std::system_error when one cannot be started.
    [[nodiscard]] bool is_done() const;

private:
    void run() noexcept;
    [[nodiscard]] bool awaits_last();

    ChildCommand& last_;
    std::vector<Before> before_;
    WakeEvent told_; // signals hurry() or the end
    WakeEvent done_;
    std::atomic<bool> is_hurried_{false};
    std::atomic<bool> is_over_{false};
    std::atomic<bool> is_done_{false};
    std::exception_ptr failure_; // written before is_done_
    std::thread thread_;         // last member: it uses the others
};

} // namespace hapnet::net
