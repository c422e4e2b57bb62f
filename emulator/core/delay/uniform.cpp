// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/uniform.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::emulator {

base::Result<void> UniformLaw::validate() const { return require_ranges(*this); }

LawMoments UniformLaw::moments() const
{
    return {mean, rounded(base::to_nanoseconds(half_width) / std::sqrt(3.0))};
}

UniformLaw::Sampler::Sampler(const UniformLaw& law)
    : mean_{law.mean}, half_width_{base::to_nanoseconds(law.half_width)}
{}

base::Duration UniformLaw::Sampler::quantile(double u) const
{
    const auto value = mean_ + base::Duration{std::llround((2.0 * u - 1.0) * half_width_)};
    return std::clamp(value, -longest_delay, longest_delay);
}

} // namespace hapnet::emulator
