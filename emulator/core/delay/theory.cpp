// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/theory.hpp"

#include "emulator/core/delay/trace.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace hapnet::emulator {

namespace {

struct LawMoments {
    base::Duration mean;
    std::optional<base::Duration> sd;
};

base::Duration nanoseconds(double count) { return base::Duration{std::llround(count)}; }

LawMoments moments(const ConstantLaw& law) { return {law.value, base::Duration{0}}; }

LawMoments moments(const UniformLaw& law)
{
    return {law.mean, nanoseconds(base::to_nanoseconds(law.half_width) / std::sqrt(3.0))};
}

LawMoments moments(const NormalLaw& law) { return {law.mean, law.sd}; }

LawMoments moments(const LogNormalLaw& law) { return {law.mean, law.sd}; }

LawMoments moments(const ExponentialLaw& law) { return {law.mean, law.mean}; }

LawMoments moments(const ParetoLaw& law)
{
    if (law.shape <= 2.0) return {law.mean, std::nullopt};
    const double variance_of_unit_mean = 1.0 / (law.shape * (law.shape - 2.0));
    const double sd = base::to_nanoseconds(law.mean) * std::sqrt(variance_of_unit_mean);
    if (sd > base::to_nanoseconds(longest_delay)) return {law.mean, std::nullopt};
    return {law.mean, nanoseconds(sd)};
}

LawMoments moments(const GammaLaw& law) { return {law.mean, law.sd}; }

LawMoments moments(const TableLaw& law)
{
    const base::Duration zero{0};
    const bool is_as_measured = law.sd == zero && law.mean == zero;
    if (!is_as_measured) return {law.mean, law.sd};
    return {nanoseconds(law.table->mean()), nanoseconds(law.table->sd())};
}

LawMoments moments(const TraceLaw& law)
{
    const auto& delays = law.trace->delays();
    double mean = 0.0;
    for (std::size_t i = 0; i < delays.size(); ++i) {
        mean += law.trace->share(i) * base::to_nanoseconds(delays[i]);
    }
    double variance = 0.0;
    for (std::size_t i = 0; i < delays.size(); ++i) {
        const double distance = base::to_nanoseconds(delays[i]) - mean;
        variance += law.trace->share(i) * distance * distance;
    }
    return {nanoseconds(mean), nanoseconds(std::sqrt(variance))};
}

} // namespace

DelayTheory::DelayTheory(const DelayLaw& law) : sampler_{ConstantSampler{}}
{
    const auto [mean, sd] = std::visit([](const auto& stated) { return moments(stated); }, law);
    mean_ = mean;
    sd_ = sd;
    const auto* traced = std::get_if<TraceLaw>(&law);
    if (!traced) {
        sampler_ = make_sampler(law);
        return;
    }
    const auto& delays = traced->trace->delays();
    for (std::size_t i = 0; i < delays.size(); ++i) {
        steps_.push_back({delays[i], traced->trace->share(i)});
    }
    const auto by_delay = [](const Step& a, const Step& b) { return a.delay < b.delay; };
    std::sort(steps_.begin(), steps_.end(), by_delay);
    double sum = 0.0;
    for (Step& step : steps_) {
        sum += step.share;
        step.share = std::min(sum, 1.0);
    }
    steps_.back().share = 1.0;
}

base::Duration DelayTheory::quantile(double q)
{
    base::ensure(q > 0.0 && q < 1.0);
    if (steps_.empty()) {
        return std::visit([q](auto& sampler) { return sampler.quantile(q); }, sampler_);
    }
    const auto up_to = [](const Step& step, double share) { return step.share < share; };
    return std::lower_bound(steps_.begin(), steps_.end(), q, up_to)->delay;
}

double DelayTheory::share_below(base::Duration limit)
{
    if (const auto value = constant()) return *value < limit ? 1.0 : 0.0;
    if (!steps_.empty()) {
        const auto below = [](const Step& step, base::Duration end) { return step.delay < end; };
        const auto first = std::lower_bound(steps_.begin(), steps_.end(), limit, below);
        return first == steps_.begin() ? 0.0 : std::prev(first)->share;
    }
    constexpr double least = 0x1p-54;
    constexpr double most = 1.0 - 0x1p-53;
    if (quantile(least) >= limit) return 0.0;
    if (quantile(most) < limit) return 1.0;
    double below = least;
    double above = most;
    while (above - below > 1e-15) {
        const double middle = 0.5 * (below + above);
        (quantile(middle) < limit ? below : above) = middle;
    }
    return below;
}

std::optional<base::Duration> DelayTheory::constant() const
{
    if (!steps_.empty()) return std::nullopt;
    if (const auto* sampler = std::get_if<ConstantSampler>(&sampler_)) return sampler->value;
    return std::nullopt;
}

double clipped_share(const DelayLaw& delay, const DelayLaw& jitter)
{
    DelayTheory one{delay};
    DelayTheory other{jitter};
    if (const auto constant = one.constant()) return other.share_below(-*constant);
    if (const auto constant = other.constant()) return one.share_below(-*constant);
    // P(one + other < 0), an average over the quantiles of the one.
    constexpr int parts = 1000;
    double sum = 0.0;
    for (int i = 0; i < parts; ++i) sum += other.share_below(-one.quantile((i + 0.5) / parts));
    return sum / parts;
}

} // namespace hapnet::emulator
