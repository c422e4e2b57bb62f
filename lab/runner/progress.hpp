// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/runner/runner.hpp"
#include "proto/base/time.hpp"
#include "proto/net/terminal_line.hpp"

#include <string>

namespace hapnet::lab::runner {

/// Returns a text such as "412/~1300 sessions (31 %), 41.2/s, 22 s left". The total is extrapolated
/// from the finished jobs. `reused` sessions took no time.
[[nodiscard]] std::string progress_text(const RunProgress& progress, base::Duration elapsed);

/// The line of progress on stderr. On a terminal it is rewritten in place; elsewhere a new line
/// appears now and then.
class ProgressLine {
public:
    explicit ProgressLine(base::TimePoint start);

    void show(const RunProgress& progress, base::TimePoint now);
    /// Ends the line and leaves its last text on the screen.
    void finish();

private:
    base::TimePoint start_;
    base::TimePoint next_;
    net::TerminalLine line_;
    bool is_over_ = false; // true once the last line has been shown
};

} // namespace hapnet::lab::runner
