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
    const double apart_s = base::to_seconds(at - at_);
    if (!(apart_s > 0.0)) return;
    const double theta = time_constant_s_ > 0.0 ? base::exp(-apart_s / time_constant_s_) : 0.0;
    const double alpha = 1.0 - theta * theta;
    const double beta = (1.0 - theta) * (1.0 - theta);
    const glm::dvec3 expected = value_ + apart_s * slope_;
    const glm::dvec3 residual = sample - expected;
    at_ = at;
    value_ = expected + alpha * residual;
    slope_ = slope_ + (beta / apart_s) * residual;
}

} // namespace hapnet::peer
