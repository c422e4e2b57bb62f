// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/net/terminal_line.hpp"
#include "proto/net/text_queue.hpp"

#include <chrono>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <unistd.h>

namespace hapnet::emulator {

/// The output of a run on stderr while it lasts: messages, and on a terminal a status line below
/// them. A thread of its own writes them, so that a blocked terminal does not delay the relay.
class Status {
public:
    explicit Status(base::TimePoint now)
    {
        if (line_.is_terminal()) next_ = now;
    }

    [[nodiscard]] std::optional<base::TimePoint> next_deadline() const { return next_; }

    /// Shows the status line that `line` returns, if the time for an update has come.
    void show(const auto& line, base::TimePoint now)
    {
        if (!base::is_due(next_, now)) return;
        next_ = now + std::chrono::milliseconds{500};
        const std::string text = line();
        const std::scoped_lock guard{lock_};
        screen_.put(line_.shown(text));
    }

    /// Prints a message: a sentence without the program's name. Call it from any thread.
    void say(std::string_view message);

    /// Removes the status line, and waits at most a second for the messages to be written.
    void finish();

private:
    std::mutex lock_;
    net::TextQueue screen_{STDERR_FILENO};
    net::TerminalLine line_{STDERR_FILENO};
    std::optional<base::TimePoint> next_; // next update of the line; nullopt: no terminal
};

} // namespace hapnet::emulator
