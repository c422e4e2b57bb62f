// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/alpha_beta.hpp"

#include "proto/base/math.hpp"

namespace hapnet::peer {

void AlphaBeta::restart(const glm::dvec3& sample, base::TimePoint at)
{
    at_ = at;
    value_ = sample;
    slope_ = glm::dvec3{0.0};
}

void AlphaBeta::add(const glm::dvec3& sample, base::TimePoint at)
{
    const base::Duration apart = at - at_;
    if (apart <= base::Duration{0}) return;
    const double apart_s = base::to_seconds(apart);
    if (apart != gains_.apart) gains_ = gains_for(apart);
    const glm::dvec3 expected = value_ + apart_s * slope_;
    const glm::dvec3 residual = sample - expected;
    at_ = at;
    value_ = expected + gains_.alpha * residual;
    slope_ = slope_ + gains_.beta_per_s * residual;
}

AlphaBeta::Gains AlphaBeta::gains_for(base::Duration apart) const
{
    const double apart_s = base::to_seconds(apart);
    const double theta = time_constant_s_ > 0.0 ? base::exp(-apart_s / time_constant_s_) : 0.0;
    return {.apart = apart,
            .alpha = 1.0 - theta * theta,
            .beta_per_s = (1.0 - theta) * (1.0 - theta) / apart_s};
}

} // namespace hapnet::peer
