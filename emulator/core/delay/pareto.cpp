// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/pareto.hpp"

#include "proto/base/math.hpp"

#include <cmath>

namespace hapnet::emulator {

base::Result<void> ParetoLaw::validate() const
{
    return all({require_ranges(*this), require(shape > 1.0 && std::isfinite(shape),
                                               "shape must be more than 1, or there is no mean")});
}

LawMoments ParetoLaw::moments() const
{
    if (shape <= 2.0) return {mean, std::nullopt};
    const double variance_of_unit_mean = 1.0 / (shape * (shape - 2.0));
    const double sd = base::to_nanoseconds(mean) * std::sqrt(variance_of_unit_mean);
    if (sd > base::to_nanoseconds(longest_delay)) return {mean, std::nullopt};
    return {mean, rounded(sd)};
}

ParetoLaw::Sampler::Sampler(const ParetoLaw& law)
    : least_{base::to_nanoseconds(law.mean) * (law.shape - 1.0) / law.shape},
      exponent_{1.0 / law.shape}
{}

base::Duration ParetoLaw::Sampler::quantile(double u) const
{
    return bounded(least_ * base::exp(-exponent_ * base::log(1.0 - u)));
}

} // namespace hapnet::emulator
