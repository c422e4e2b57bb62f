// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/exponential.hpp"

#include "proto/base/math.hpp"

namespace hapnet::emulator {

base::Result<void> ExponentialLaw::validate() const { return require_ranges(*this); }

LawMoments ExponentialLaw::moments() const { return {mean, mean}; }

ExponentialLaw::Sampler::Sampler(const ExponentialLaw& law) : mean_{base::to_nanoseconds(law.mean)}
{}

base::Duration ExponentialLaw::Sampler::quantile(double u) const
{
    return bounded(-mean_ * base::log(1.0 - u));
}

} // namespace hapnet::emulator
