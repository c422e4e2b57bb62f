// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/velocity_filter.hpp"

#include "proto/base/math.hpp"

namespace hapnet::device {

base::Velocity VelocityFilter::at(base::Position position, base::TimePoint now)
{
    if (last_ && now > last_->time) {
        if (now - last_->time != elapsed_) {
            elapsed_ = now - last_->time;
            const double seconds = base::to_seconds(elapsed_);
            keeps_ = base::exp(-base::two_pi * cutoff_hertz_ * seconds);
            gain_per_s_ = (1.0 - keeps_) / seconds;
        }
        velocity_ = keeps_ * velocity_ + gain_per_s_ * (position - last_->position).value;
    }
    last_ = Last{now, position};
    return {velocity_};
}

} // namespace hapnet::device
