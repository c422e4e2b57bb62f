// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/log_normal.hpp"

#include "proto/base/math.hpp"
#include "proto/base/normal.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::emulator {

base::Result<void> LogNormalLaw::validate() const
{
    return all(
        {require_ranges(*this), require(mean > base::Duration{0}, "mean must be more than 0")});
}

LawMoments LogNormalLaw::moments() const { return {mean, sd}; }

LogNormalLaw::Sampler::Sampler(const LogNormalLaw& law)
{
    const double mean_ns = std::max(base::to_nanoseconds(law.mean), 1.0);
    const double spread = base::to_nanoseconds(law.sd) / mean_ns;
    const double log_variance = base::log1p(spread * spread);
    log_mean_ = base::log(mean_ns) - 0.5 * log_variance;
    log_sd_ = std::sqrt(log_variance);
}

base::Duration LogNormalLaw::Sampler::quantile(double u) const
{
    return bounded(base::exp(log_mean_ + log_sd_ * base::normal_quantile(u)));
}

} // namespace hapnet::emulator
