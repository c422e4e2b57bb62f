// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/sleep_policy.hpp"

#include <algorithm>
#include <chrono>

namespace hapnet::emulator {

namespace {

using namespace std::chrono_literals;

constexpr base::Duration awake_max = 10ms;
constexpr base::Duration rest = 50us; // half a per cent of awake_max

/// The margin changes by these amounts at each wake-up that leaves too little of it, or enough. In
/// balance one in a hundred leaves too little. At 1000 wake-ups a second it grows by up to 2 us a
/// millisecond and shrinks by up to 20 us a second.
constexpr base::Duration margin_growth = 1980ns;
constexpr base::Duration margin_decay = 20ns;

/// The time for a warm-up, which usually takes 10 us and sometimes 14 us (measured as above) and
/// must not cause lateness.
constexpr base::Duration warm_up_time = 15us;

/// The initial estimate of the cost of a wake-up (measured 2026, 2 virtual CPUs, Linux 6.18).
constexpr base::Duration margin_at_start = 60us;

} // namespace

SleepPolicy::SleepPolicy(Margin limits, base::TimePoint now, Watching watching)
    : limits_{limits},
      watching_{watching},
      budget_{now},
      margin_{std::clamp(margin_at_start, limits.least, limits.most)},
      slept_{now}
{}

SleepPolicy::Plan SleepPolicy::plan(std::optional<base::TimePoint> deadline,
                                    base::TimePoint now) const
{
    if (now - slept_ > awake_max) return Yield{now + rest};
    if (!deadline) return Sleep{};
    const auto margin = may_watch() ? margin_ : base::Duration{0};
    if (*deadline - now > margin) return Sleep{*deadline - margin};
    return Spin{.warm_up = is_cold_ && *deadline - now >= warm_up_time};
}

void SleepPolicy::on_wake_up(const Plan& plan, const WakeUp& wake_up)
{
    if (wake_up.woke_at - wake_up.slept_at >= rest / 2) {
        slept_ = wake_up.woke_at;
        is_cold_ = true;
    }
    const auto* sleep = std::get_if<Sleep>(&plan);
    if (sleep == nullptr || wake_up.by_datagram || !base::is_due(sleep->until, wake_up.woke_at)) {
        return; // this wake-up was not by a timer
    }
    const bool is_late = wake_up.woke_at - *sleep->until + warm_up_time > margin_;
    margin_ = std::clamp(margin_ + (is_late ? margin_growth : -margin_decay), limits_.least,
                         limits_.most);
}

} // namespace hapnet::emulator
