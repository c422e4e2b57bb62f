// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/governor.hpp"

#include <algorithm>

namespace hapnet::device {

base::Force Governor::limit(base::Force wanted, bool permitted, base::TimePoint now)
{
    const double elapsed = last_time_ ? base::to_seconds(now - *last_time_) : 0.0;
    last_time_ = now;

    const base::Duration full_swing = permitted ? limits_.ramp_in : limits_.fade_out;
    const double change = elapsed / base::to_seconds(full_swing);
    strength_ = std::clamp(strength_ + (permitted ? change : -change), 0.0, 1.0);
    if (strength_ < 1.0) ++counters_.faded;

    if (!base::is_finite(wanted)) {
        ++counters_.not_finite;
        last_ = {};
        return last_;
    }
    base::Force force = base::limited(wanted, limits_.force_max_n);
    if (!(force == wanted)) ++counters_.clamped;
    force = strength_ * force;

    const double step_max = limits_.slew_max_n_per_s * elapsed;
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
