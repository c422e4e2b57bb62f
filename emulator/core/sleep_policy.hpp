// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/watch_budget.hpp"
#include "proto/base/time.hpp"

#include <cstdint>
#include <optional>
#include <variant>

namespace hapnet::emulator {

/// Decides when a relay sleeps and when it spins on the clock, from times alone. A sleep ends late
/// by the time that the machine needs to wake up. So the planned end of a sleep is a margin before
/// the deadline, and the relay spins for the rest. The margin follows the observed wake-ups,
/// between two limits, so that nearly all of them leave time for a warm-up: it grows fast and
/// shrinks slowly.
///
/// It also ensures that a busy relay sleeps at times. A SCHED_FIFO thread that never sleeps keeps
/// the kernel from receiving (ksoftirqd), and the kernel stops one that rarely sleeps so that other
/// programs can run. So the relay spins only as long as a WatchBudget lasts.
class SleepPolicy {
public:
    /// The least and the greatest margin. If both are equal, the margin is fixed.
    struct Margin {
        base::Duration least{};
        base::Duration most{};
    };

    enum class Watching : std::uint8_t { within_budget, without_limit };

    struct Spin { // the caller returns at once and reads the clock again
        /// True if there is time to bring code and data for a datagram into the caches, which a
        /// sleep has emptied.
        bool warm_up = false;
    };
    struct Sleep { // until a datagram comes, or until the time `until`
        std::optional<base::TimePoint> until;
    };
    struct Yield { // sleep until this time, even if a datagram comes
        base::TimePoint until;
    };
    using Plan = std::variant<Spin, Sleep, Yield>;

    SleepPolicy(Margin limits, base::TimePoint now, Watching watching = Watching::within_budget);

    /// Returns the plan at `now` for the time before `deadline`; nullopt: there is no deadline.
    [[nodiscard]] Plan plan(std::optional<base::TimePoint> deadline, base::TimePoint now) const;

    struct WakeUp {
        base::TimePoint slept_at;
        base::TimePoint woke_at;
        bool by_datagram = false;
    };

    /// Takes the outcome of `plan`.
    void on_wake_up(const Plan& plan, const WakeUp& wake_up);

    /// True if on_usage() is to be called.
    [[nodiscard]] bool wants_usage(base::TimePoint now) const { return budget_.wants_usage(now); }

    /// Takes the processor time that the relay's thread has used since it began.
    void on_usage(base::Duration processor_time, base::TimePoint now)
    {
        budget_.on_usage(processor_time, now);
    }

    /// Notes that the planned warm-up has been done.
    void on_warm_up() { is_cold_ = false; }

    [[nodiscard]] base::Duration margin() const { return margin_; }

private:
    [[nodiscard]] bool may_watch() const
    {
        return watching_ == Watching::without_limit || budget_.permits();
    }

    Margin limits_;
    Watching watching_;
    WatchBudget budget_;
    base::Duration margin_;
    base::TimePoint slept_; // when a real sleep last ended
    bool is_cold_ = false;  // no warm-up since that sleep
};

} // namespace hapnet::emulator
