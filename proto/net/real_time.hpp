// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"

#include <cstdint>
#include <string>

namespace hapnet::net {

/// The privileges of a 1 kHz loop that the system granted.
struct RealTime {
    bool fifo = false;          // SCHED_FIFO
    bool locked_memory = false; // mlockall
    /// Returns "" if everything was granted. Otherwise returns one sentence that says what is
    /// missing and how to allow it.
    [[nodiscard]] std::string shortage() const;
};
constexpr auto fields_of(base::Tag<RealTime>)
{
    return base::fields(
        "real time",
        base::member("fifo", &RealTime::fifo, "Whether the system granted SCHED_FIFO."),
        base::member("locked_memory", &RealTime::locked_memory,
                     "Whether it granted locked memory."));
}

/// The pages that are locked: all reserved memory at once, or each page when it is first used. The
/// latter is for a process that reserves far more memory than it usually needs.
enum class Locking : std::uint8_t { at_once, as_used };

/// Requests SCHED_FIFO at `priority` and the finest timer slack for the calling thread, and locked
/// memory for the process. Never fails; the result says what was granted.
[[nodiscard]] RealTime request_real_time(int priority, Locking locking = Locking::at_once);

/// Returns the calling thread to normal scheduling. Call this before long work that nothing waits
/// for.
void leave_real_time();

} // namespace hapnet::net
