// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/governor.hpp"

#include <algorithm>

namespace hapnet::device {

GovernedForce Governor::govern(const Wish& wish, const Sample& sample, base::TimePoint now)
{
    const bool usable = sample.fault == Fault::none && sample.calibrated && !sample.docked;
    const base::Force force = limit(wish.force, wish.permitted && usable, now);
    return strength_ > 0.0 ? GovernedForce{force} : GovernedForce{};
}

base::Force Governor::limit(base::Force wanted, bool permitted, base::TimePoint now)
{
    base::Duration gap = last_time_ ? now - *last_time_ : base::Duration{0};
    last_time_ = now;
    if (gap > limits_.stall_max) {
        ++counters_.stalled;
        strength_ = 0.0;
        last_ = {};
        gap = base::Duration{0}; // as if this were the first tick
    }
    const base::Duration step_time = std::min(gap, limits_.tick);

    // A late tick fades by all the time that has passed, but ramps in by one tick only.
    const double change = permitted
                              ? base::to_seconds(step_time) / base::to_seconds(limits_.ramp_in)
                              : -base::to_seconds(gap) / base::to_seconds(limits_.fade_out);
    strength_ = std::clamp(strength_ + change, 0.0, 1.0);
    if (strength_ < 1.0) ++counters_.faded;

    if (!base::is_finite(wanted)) {
        ++counters_.not_finite;
        last_ = {};
        return last_;
    }
    base::Force force = base::limited(wanted, limits_.force_max_n);
    if (!(force == wanted)) ++counters_.clamped;
    force = strength_ * force;

    const double step_max = limits_.slew_max_n_per_s * base::to_seconds(step_time);
    const base::Force step = force - last_;
    if (base::norm(step) > step_max) {
        ++counters_.slewed;
        force = last_ + base::limited(step, step_max);
    }
    if (strength_ == 0.0) force = {}; // zero when in doubt, whatever the slew
    last_ = force;
    return force;
}

} // namespace hapnet::device
