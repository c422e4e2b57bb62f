// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/control/core/work.hpp"
#include "proto/net/wake_event.hpp"

#include <atomic>
#include <chrono>
#include <exception>
#include <optional>

namespace hapnet::control {

/// Thrown by run() when the loop has ended before the work was done.
class LoopHasEnded : public std::exception {
public:
    [[nodiscard]] const char* what() const noexcept override { return "the loop has ended"; }
};

/// Work that another thread requests, on data of a loop that must not be delayed. The loop does it
/// between two of its rounds, one step at a time, at least `pause` apart: with steps of 50 us this
/// takes at most a quarter of the loop's time. No step is done just before a departure.
class Turns {
public:
    static constexpr base::Duration pause = std::chrono::microseconds{200};
    /// The largest duration of a step. put_off_max is the longest delay of a step while departures
    /// are due.
    static constexpr base::Duration step_takes = std::chrono::microseconds{100};
    static constexpr base::Duration put_off_max = std::chrono::milliseconds{20};

    // For the thread that requests the work, which is always the same one.

    /// Runs the work like DoWork. Throws LoopHasEnded.
    void run(const Step& step);

    // For the loop's thread.

    /// Readable when work has been requested.
    [[nodiscard]] int descriptor() const { return ordered_.descriptor(); }
    /// Returns when the next step may be done; nullopt: there is no work.
    [[nodiscard]] std::optional<base::TimePoint> next_deadline() const;
    /// True if a step can be done now.
    [[nodiscard]] bool is_due(base::TimePoint now,
                              std::optional<base::TimePoint> next_departure) const;
    /// Does one step.
    void take(base::TimePoint now);
    /// Prevents any further step. run() throws from now on.
    void close();

private:
    net::WakeEvent ordered_;
    std::atomic<const Step*> work_{nullptr};
    std::atomic<bool> is_closed_{false};
    bool is_done_ = false;        // true: work_ became null because the work ended, not by close()
    base::TimePoint last_step_{}; // time of the last step
};

} // namespace hapnet::control
