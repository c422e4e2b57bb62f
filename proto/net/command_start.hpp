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

/// Starts commands on its own thread. Starting a program and looking for its listener take
/// milliseconds, which would delay the thread that relays the frames of the commands.
class CommandStart {
public:
    /// A command that must start before the last one.
    struct Before {
        ChildCommand& command;
        /// Returns true once this command allows the last command to start. It is called every 10
        /// ms until then, on the starting thread.
        std::function<bool()> is_ready;
    };

    /// The time after which the last command starts in any case.
    static constexpr base::Duration patience = std::chrono::seconds{1};

    /// Starts all of `before`, in their order. Starts `last` once each of them is ready, or has
    /// ended without background processes that may still begin to listen. Until is_done(), other
    /// threads may only ask for the exit codes of the commands.
    CommandStart(ChildCommand& last, std::vector<Before> before);
    /// Ends the thread. Commands that have not started yet are not started.
    ~CommandStart();
    CommandStart(const CommandStart&) = delete;
    CommandStart& operator=(const CommandStart&) = delete;

    /// Starts the last command without waiting any longer.
    void hurry();

    /// Readable when is_done() may have changed.
    [[nodiscard]] int descriptor() const { return done_.descriptor(); }
    /// True once all commands have started. Throws std::system_error if one cannot be started.
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
    std::exception_ptr failure_; // written before is_done_ is set
    std::thread thread_;         // last member: it uses the others
};

} // namespace hapnet::net
