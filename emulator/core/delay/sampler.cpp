// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/sampler.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/math.hpp"
#include "proto/base/normal.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::emulator {

namespace {

base::Duration rounded(double nanoseconds)
{
    constexpr auto most = static_cast<double>(longest_delay.count());
    return base::Duration{std::llround(std::clamp(nanoseconds, -most, most))};
}

Sampler prepared(const ConstantLaw& law) { return ConstantSampler{law.value}; }

Sampler prepared(const UniformLaw& law)
{
    return UniformSampler{law.mean, base::to_nanoseconds(law.half_width)};
}

Sampler prepared(const NormalLaw& law)
{
    return NormalSampler{base::to_nanoseconds(law.mean), base::to_nanoseconds(law.sd)};
}

Sampler prepared(const LogNormalLaw& law)
{
    const double mean = std::max(base::to_nanoseconds(law.mean), 1.0);
    const double spread = base::to_nanoseconds(law.sd) / mean;
    const double log_variance = base::log1p(spread * spread);
    return LogNormalSampler{base::log(mean) - 0.5 * log_variance, std::sqrt(log_variance)};
}

Sampler prepared(const ExponentialLaw& law)
{
    return ExponentialSampler{base::to_nanoseconds(law.mean)};
}

Sampler prepared(const ParetoLaw& law)
{
    return ParetoSampler{base::to_nanoseconds(law.mean) * (law.shape - 1.0) / law.shape,
                         1.0 / law.shape};
}

double shape_of(const GammaLaw& law)
{
    const double ratio =
        base::to_nanoseconds(law.mean) / std::max(base::to_nanoseconds(law.sd), 1.0);
    return std::max(ratio * ratio, GammaQuantile::shape_min);
}

Sampler prepared(const GammaLaw& law)
{
    const double shape = shape_of(law);
    return GammaSampler{base::to_nanoseconds(law.mean), shape, GammaQuantile{shape}};
}

Sampler prepared(const TableLaw& law)
{
    base::ensure(law.table != nullptr);
    const QuantileTable& table = *law.table;
    const base::Duration zero{0};
    if (law.sd == zero && law.mean == zero && table.holds_delays()) {
        return TableSampler{0.0, 1.0, law.table};
    }
    const double scale = table.sd() > 0.0 ? base::to_nanoseconds(law.sd) / table.sd() : 0.0;
    return TableSampler{base::to_nanoseconds(law.mean) - scale * table.mean(), scale, law.table};
}

Sampler prepared(const TraceLaw&)
{
    base::ensure(false);
    return ConstantSampler{};
}

} // namespace

base::Duration ConstantSampler::quantile(double) const { return value; }

base::Duration UniformSampler::quantile(double u) const
{
    const auto value = mean + base::Duration{std::llround((2.0 * u - 1.0) * half_width)};
    return std::clamp(value, -longest_delay, longest_delay);
}

base::Duration NormalSampler::quantile(double u) const
{
    return rounded(mean + sd * base::normal_quantile(u));
}

base::Duration LogNormalSampler::quantile(double u) const
{
    return rounded(base::exp(log_mean + log_sd * base::normal_quantile(u)));
}

base::Duration ExponentialSampler::quantile(double u) const
{
    return rounded(-mean * base::log(1.0 - u));
}

base::Duration ParetoSampler::quantile(double u) const
{
    return rounded(least * base::exp(-exponent * base::log(1.0 - u)));
}

base::Duration GammaSampler::quantile(double u)
{
    return rounded(mean * quantiles.at(base::normal_quantile(u)));
}

base::Duration TableSampler::quantile(double u) const
{
    return rounded(offset + scale * table->quantile(u));
}

Sampler make_sampler(const DelayLaw& law)
{
    return std::visit([](const auto& stated) { return prepared(stated); }, law);
}

void adapt(Sampler& sampler, const DelayLaw& law)
{
    auto* gamma = std::get_if<GammaSampler>(&sampler);
    const auto* gamma_law = std::get_if<GammaLaw>(&law);
    if (gamma && gamma_law && gamma->shape == shape_of(*gamma_law)) {
        gamma->mean = base::to_nanoseconds(gamma_law->mean);
        return;
    }
    sampler = make_sampler(law);
}

} // namespace hapnet::emulator
