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

/// Work on what belongs to a loop that must not be kept waiting, ordered by another thread. The
/// loop does it between two of its rounds, a step at a time, at least `pause` apart: with steps of
/// 50 us it spends a quarter of its time on it at most. Before a departure that is near, it waits.
class Turns {
public:
    static constexpr base::Duration pause = std::chrono::microseconds{200};
    /// Largest duration of a step, and longest delay of a step while departures are due.
    static constexpr base::Duration step_takes = std::chrono::microseconds{100};
    static constexpr base::Duration put_off_max = std::chrono::milliseconds{20};

    // For the thread that orders. It is always the same one.

    /// See DoWork. Throws LoopHasEnded.
    void run(const Step& step);

    // For the loop's thread.

    /// Readable when work has been ordered.
    [[nodiscard]] int descriptor() const { return ordered_.descriptor(); }
    /// Returns when the next step may be done; nullopt: there is no work.
    [[nodiscard]] std::optional<base::TimePoint> next_deadline() const;
    /// True if a step can be done now.
    [[nodiscard]] bool is_due(base::TimePoint now,
                              std::optional<base::TimePoint> next_departure) const;
    /// Does one step.
    void take(base::TimePoint now);
    /// No more steps are done; run() throws from now on.
    void close();

private:
    net::WakeEvent ordered_;
    std::atomic<const Step*> work_{nullptr};
    std::atomic<bool> is_closed_{false};
    bool is_done_ = false;        // work_ became null at the end of the work, not by close()
    base::TimePoint last_step_{}; // time of the last step
};

} // namespace hapnet::control
