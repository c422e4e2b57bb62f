// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/runner/runner.hpp"
#include "proto/base/time.hpp"
#include "proto/net/terminal_line.hpp"

#include <string>

namespace hapnet::lab::runner {

/// "412/~1300 sessions (31 %), 41.2/s, 22 s left": the total is what the jobs that are done make
/// likely. `reused` sessions took no time.
[[nodiscard]] std::string progress_text(const RunProgress& progress, base::Duration elapsed);

/// The line of progress on stderr: rewritten in place on a terminal, else a new line now and then.
class ProgressLine {
public:
    explicit ProgressLine(base::TimePoint start);

    void show(const RunProgress& progress, base::TimePoint now);
    /// Leaves the line as it is.
    void finish();

private:
    base::TimePoint start_;
    base::TimePoint next_;
    net::TerminalLine line_;
    bool is_over_ = false; // true once the last line has been shown
};

} // namespace hapnet::lab::runner
