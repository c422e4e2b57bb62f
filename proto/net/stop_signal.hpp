// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

namespace hapnet::net {

/// SIGINT, SIGTERM and SIGHUP (the terminal has gone) as something to wait for. Construct one,
/// first thing in main and before any thread: from then on they interrupt nothing and are read
/// here. SIGPIPE is
/// ignored from then on: a reader that has left must not end a session.
class StopSignal {
public:
    StopSignal();
    ~StopSignal();
    StopSignal(const StopSignal&) = delete;
    StopSignal& operator=(const StopSignal&) = delete;

    /// Readable once a signal has come.
    [[nodiscard]] int descriptor() const { return descriptor_; }

    /// Whether one of them has come since construction; stays true.
    [[nodiscard]] bool requested();

private:
    int descriptor_ = -1;
    bool requested_ = false;
};

} // namespace hapnet::net
