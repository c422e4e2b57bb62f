// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace hapnet::net {

/// What SIGHUP means: that the terminal has gone, or that a file is to be read again.
enum class Hangup : std::uint8_t { stop, reload };

/// SIGINT, SIGTERM and SIGHUP as something to wait for. Construct one, first thing in main and
/// before any thread: from then on they interrupt nothing and are read here. SIGPIPE is ignored
/// from then on: a reader that has left must not end a session.
class StopSignal {
public:
    explicit StopSignal(Hangup hangup = Hangup::stop);
    ~StopSignal();
    StopSignal(const StopSignal&) = delete;
    StopSignal& operator=(const StopSignal&) = delete;

    /// Readable once a signal has come.
    [[nodiscard]] int descriptor() const { return descriptor_; }

    /// Whether one that means stop has come since construction; stays true.
    [[nodiscard]] bool requested();

    /// Whether one that means reload has come since the last call.
    [[nodiscard]] bool reload_requested();

private:
    void take();

    Hangup hangup_;
    int descriptor_ = -1;
    bool requested_ = false;
    bool reload_requested_ = false;
};

} // namespace hapnet::net
