// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/figures/moments.hpp"

#include <cmath>

namespace hapnet::base {

Duration nearest_duration(double nanoseconds)
{
    return Duration{static_cast<Duration::rep>(std::floor(nanoseconds + 0.5))};
}

std::optional<Moments> RunningMoments::moments() const
{
    if (count_ == 0) return std::nullopt;
    Moments moments{nearest_duration(mean_ns_), {}};
    if (count_ > 1) {
        moments.sd = nearest_duration(std::sqrt(squares_ / static_cast<double>(count_ - 1)));
    }
    return moments;
}

} // namespace hapnet::base
