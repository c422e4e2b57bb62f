// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/theory.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <iterator>

namespace hapnet::emulator {

DelayTheory::DelayTheory(const DelayLaw& law) : sampler_{make_sampler(law)}
{
    const auto moments = std::visit([](const auto& stated) { return stated.moments(); }, law);
    mean_ = moments.mean;
    sd_ = moments.sd;
    if (const auto* trace = std::get_if<TraceLaw>(&law)) steps_ = trace->steps();
}

base::Duration DelayTheory::quantile(double q)
{
    base::ensure(q > 0.0 && q < 1.0);
    if (steps_.empty()) {
        return std::visit(
            [q](auto& sampler) {
                if constexpr (requires { sampler.quantile(q); }) return sampler.quantile(q);
                base::ensure(false); // a trace has steps
                return base::Duration{};
            },
            sampler_);
    }
    const auto up_to = [](const TraceLaw::Step& step, double share) { return step.share < share; };
    return std::lower_bound(steps_.begin(), steps_.end(), q, up_to)->delay;
}

double DelayTheory::share_below(base::Duration limit)
{
    if (const auto value = constant()) return *value < limit ? 1.0 : 0.0;
    if (!steps_.empty()) {
        const auto below = [](const TraceLaw::Step& step, base::Duration end) {
            return step.delay < end;
        };
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
    const auto* sampler = std::get_if<ConstantLaw::Sampler>(&sampler_);
    if (sampler == nullptr) return std::nullopt;
    return sampler->quantile(0.5);
}

double clipped_share(const DelayLaw& delay, const DelayLaw& jitter)
{
    DelayTheory one{delay};
    DelayTheory other{jitter};
    if (const auto constant = one.constant()) return other.share_below(-*constant);
    if (const auto constant = other.constant()) return one.share_below(-*constant);
    // P(one + other < 0), as an average over the quantiles of `one`.
    constexpr int parts = 1000;
    double sum = 0.0;
    for (int i = 0; i < parts; ++i) sum += other.share_below(-one.quantile((i + 0.5) / parts));
    return sum / parts;
}

} // namespace hapnet::emulator
