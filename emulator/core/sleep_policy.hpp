// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <optional>
#include <variant>

namespace hapnet::emulator {

/// Decides when a relay sleeps and when it spins on the clock, from times alone. A sleep ends late
/// by what the machine needs to wake up: so it ends a margin before the deadline, and the relay
/// spins for the rest. The margin follows the wake-ups that are seen, between two limits, so that
/// nearly all of them leave time for a warm-up: it grows fast and shrinks slowly.
///
/// It also sees to it that a busy relay sleeps at times: a SCHED_FIFO thread that never sleeps
/// keeps the kernel from receiving (ksoftirqd).
class SleepPolicy {
public:
    /// The least and the most margin; equal ones fix it.
    struct Margin {
        base::Duration least{};
        base::Duration most{};
    };

    struct Spin { // return at once and read the clock again
        /// There is time to bring the way of a datagram into the caches, which a sleep has emptied.
        bool warm_up = false;
    };
    struct Sleep { // until a datagram comes or it is time; nullopt: for a datagram alone
        std::optional<base::TimePoint> until;
    };
    struct Yield { // sleep until then, even if a datagram comes
        base::TimePoint until;
    };
    using Plan = std::variant<Spin, Sleep, Yield>;

    SleepPolicy(Margin limits, base::TimePoint now);

    /// What to do at `now` before `deadline`; nullopt: there is none.
    [[nodiscard]] Plan plan(std::optional<base::TimePoint> deadline, base::TimePoint now) const;

    struct WakeUp {
        base::TimePoint slept_at;
        base::TimePoint woke_at;
        bool by_datagram = false;
    };

    /// How `plan` went.
    void on_wake_up(const Plan& plan, const WakeUp& wake_up);

    /// The warm-up that was planned has been done.
    void on_warm_up() { is_cold_ = false; }

    [[nodiscard]] base::Duration margin() const { return margin_; }

private:
    Margin limits_;
    base::Duration margin_;
    base::TimePoint slept_; // when a real sleep last ended
    bool is_cold_ = false;  // since then
};

} // namespace hapnet::emulator
