// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <algorithm>
#include <chrono>
#include <optional>

namespace hapnet::emulator {

/// Limits the time for which a thread may watch the clock, by the processor time that it has used.
/// The kernel stops a SCHED_FIFO thread that takes nearly all of a core for 50 ms of each second,
/// so that other programs can run (the fair server of Linux 6.12, sched_rt_runtime_us before it).
/// Each datagram in that time is late. So a thread that works much watches less.
///
/// Watching is permitted as long as a budget lasts. The budget grows by `percent_max` of the time
/// that passes, and all processor time that the thread uses, work included, is subtracted from it.
class WatchBudget {
public:
    /// Without watching, 20 000 datagrams a second take 74 % of a core. With watching, 14 000 take
    /// 87 %, at which the stops begin (2 virtual CPUs, Linux 6.18, one other busy process).
    static constexpr int percent_max = 70;
    /// The limit of the time that can be saved up, or owed. The effect of a flood is over at most
    /// this long after its end.
    static constexpr base::Duration balance_max = std::chrono::milliseconds{50};
    /// The time between two readings of the processor time, each of which is a system call.
    static constexpr base::Duration look_every = std::chrono::milliseconds{5};

    explicit WatchBudget(base::TimePoint now) : looked_{now} {}

    /// True if on_usage() is to be called.
    [[nodiscard]] bool wants_usage(base::TimePoint now) const
    {
        return now - looked_ >= look_every;
    }

    /// Takes the processor time that the thread has used since it began.
    void on_usage(base::Duration used, base::TimePoint now)
    {
        const auto spent = used_ ? used - *used_ : base::Duration{0};
        balance_ += (now - looked_) * percent_max / 100 - spent;
        balance_ = std::clamp(balance_, -balance_max, balance_max);
        used_ = used;
        looked_ = now;
    }

    [[nodiscard]] bool permits() const { return balance_ > base::Duration{0}; }

private:
    base::Duration balance_ = balance_max;
    std::optional<base::Duration> used_;
    base::TimePoint looked_;
};

} // namespace hapnet::emulator
