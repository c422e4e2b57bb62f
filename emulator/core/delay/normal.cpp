// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/normal.hpp"

#include "proto/base/normal.hpp"

namespace hapnet::emulator {

base::Result<void> NormalLaw::validate() const { return require_ranges(*this); }

LawMoments NormalLaw::moments() const { return {mean, sd}; }

NormalLaw::Sampler::Sampler(const NormalLaw& law)
    : mean_{base::to_nanoseconds(law.mean)}, sd_{base::to_nanoseconds(law.sd)}
{}

base::Duration NormalLaw::Sampler::quantile(double u) const
{
    return bounded(mean_ + sd_ * base::normal_quantile(u));
}

} // namespace hapnet::emulator
