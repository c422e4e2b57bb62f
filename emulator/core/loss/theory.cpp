// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/theory.hpp"

#include "emulator/core/loss/steps.hpp"
#include "emulator/core/loss/trace.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>

namespace hapnet::emulator {

namespace {

/// `both`: the probability that two neighbours are lost.
LossTheory from_pairs(double share, double both)
{
    LossTheory theory{.share = share};
    if (share <= 0.0) return theory;
    theory.loss_after_loss = both / share;
    if (both < share) theory.mean_run = share / (share - both);
    return theory;
}

/// Of what is not drawn: so many losses in so many runs.
LossTheory from_counts(double count, double losses, double runs)
{
    return from_pairs(losses / count, (losses - runs) / count);
}

LossTheory theory(const RandomLoss& law, const Arrivals&)
{
    const double share = law.share.fraction();
    auto result = from_pairs(share, share * share);
    result.decay = 0.0;
    result.variance_inflation = 1.0;
    return result;
}

LossTheory theory(const BlockLoss& law, const Arrivals&)
{
    const double lost = law.lost;
    const double of = law.of;
    // Of n neighbouring pairs n - 1 lie within a block and one across its end.
    return from_pairs(lost / of, (lost * (lost - 1.0) / of + lost * lost / (of * of)) / of);
}

LossTheory theory(const PeriodicLoss& law, const Arrivals&)
{
    return from_counts(law.every, 1.0, law.every > 1 ? 1.0 : 0.0);
}

LossTheory theory(const Burst& law, const Arrivals&)
{
    return from_counts(law.of, law.lost, law.lost < law.of ? 1.0 : 0.0);
}

LossTheory theory(const TimedBurst& law, const Arrivals& arrivals)
{
    const auto spacing = static_cast<double>(arrivals.spacing.count());
    const double period = static_cast<double>(law.every.count()) / spacing; // in datagrams
    const auto* time = std::get_if<base::Duration>(&law.lost);
    const double lost = time != nullptr ? static_cast<double>(time->count()) / spacing
                                        : static_cast<double>(std::get<std::uint32_t>(law.lost));
    if (lost >= period) return from_counts(1.0, 1.0, 0.0);
    return from_counts(period, lost, std::min(lost, 1.0));
}

LossTheory theory(const TwoStateSteps& steps)
{
    const auto [p, r, g, b] = steps;
    const double bad = steps.bad_share();
    const double good = 1.0 - bad;
    const double share = good * g + bad * b;
    const double both = good * g * ((1.0 - p) * g + p * b) + bad * b * ((1.0 - r) * b + r * g);
    auto result = from_pairs(share, both);
    const double decay = 1.0 - p - r;
    result.decay = decay;
    result.variance_inflation = 1.0;
    if (share > 0.0 && share < 1.0 && decay < 1.0) {
        const double of_states = (b - g) * (b - g) * good * bad / (share * (1.0 - share));
        result.variance_inflation += 2.0 * of_states * decay / (1.0 - decay);
    }
    return result;
}

LossTheory theory(const Gilbert& law, const Arrivals&) { return theory(steps_of(law)); }
LossTheory theory(const GilbertElliott& law, const Arrivals&) { return theory(steps_of(law)); }
LossTheory theory(const TimedGilbertElliott& law, const Arrivals& arrivals)
{
    return theory(steps_of(law, arrivals.spacing));
}

/// By renewal: the chain begins anew whenever it comes to received_in_gap. Over one cycle of T
/// datagrams with R losses, the variance per datagram is E[(R - share T)^2] / E[T].
double cycle_variance(const FourStateSteps& s, double share)
{
    const auto square = [](double x) { return x * x; };
    // A burst: its first loss, and then a geometric number of further losses, each of them perhaps
    // after a good run.
    const double more = (1.0 - s.burst_to_gap) / s.burst_to_gap;
    const double more_variance = more / s.burst_to_gap;
    const double with_good_run =
        s.burst_to_gap < 1.0 ? s.burst_to_good_run / (1.0 - s.burst_to_gap) : 0.0;
    const double good = with_good_run / s.good_run_to_burst;
    const double good_variance =
        with_good_run * (2.0 - s.good_run_to_burst) / square(s.good_run_to_burst) - square(good);
    const double each = (1.0 - share) - share * good;
    const double burst_mean = (1.0 - 2.0 * share) + more * each;
    const double burst_variance =
        more * square(share) * good_variance + more_variance * square(each);
    return (1.0 - s.gap_to_burst - s.gap_to_isolated) * square(share) +
           s.gap_to_isolated * square(1.0 - 2.0 * share) +
           s.gap_to_burst * (square(burst_mean) + burst_variance);
}

LossTheory theory(const FourState& law, const Arrivals&)
{
    const auto steps = steps_of(law);
    const auto shares = steps.shares();
    const double share = shares.lost_in_burst + shares.lost_in_gap;
    const double stays = 1.0 - steps.burst_to_gap - steps.burst_to_good_run;
    auto result = from_pairs(share, shares.lost_in_burst * stays);
    result.variance_inflation =
        cycle_variance(steps, share) * shares.received_in_gap / (share * (1.0 - share));
    return result;
}

LossTheory theory(const ListedLoss& law, const Arrivals& arrivals)
{
    double losses = 0.0;
    double runs = 0.0;
    for (std::size_t i = 0; i < law.numbers.size() && law.numbers[i] < arrivals.count; ++i) {
        losses += 1.0;
        if (i == 0 || law.numbers[i - 1] + 1 != law.numbers[i]) runs += 1.0;
    }
    return from_counts(static_cast<double>(arrivals.count), losses, runs);
}

/// Of what repeats after `size` datagrams.
template <typename IsLost>
LossTheory of_period(std::size_t size, IsLost&& is_lost)
{
    double losses = 0.0;
    double runs = 0.0;
    for (std::size_t i = 0; i < size; ++i) {
        if (!is_lost(i)) continue;
        losses += 1.0;
        if (!is_lost((i + size - 1) % size)) runs += 1.0;
    }
    return from_counts(static_cast<double>(size), losses, runs);
}

LossTheory theory(const PatternLoss& law, const Arrivals&)
{
    return of_period(law.pattern.size(), [&](std::size_t i) { return bool{law.pattern[i]}; });
}

LossTheory theory(const TraceLoss& law, const Arrivals&)
{
    base::ensure(law.trace != nullptr);
    return of_period(law.trace->size(), [&](std::size_t i) { return law.trace->is_lost(i); });
}

LossTheory theory(const Outage& law, const Arrivals& arrivals)
{
    // Datagram n comes at n times the spacing: how many come before a time.
    const auto count = static_cast<double>(arrivals.count);
    const auto before = [&](base::Duration time) {
        const auto whole = time / arrivals.spacing;
        const auto part = time % arrivals.spacing > base::Duration{0} ? 1 : 0;
        return std::min(static_cast<double>(whole + part), count);
    };
    double losses = 0.0;
    double runs = 0.0;
    for (const Window& window : law.windows) {
        const double lost = before(window.to) - before(window.from);
        losses += lost;
        if (lost > 0.0) runs += 1.0;
    }
    return from_counts(count, losses, runs);
}

} // namespace

LossTheory theory_of(const LossLaw& law, const Arrivals& arrivals)
{
    base::ensure(arrivals.spacing > base::Duration{0} && arrivals.count > 0);
    return std::visit([&](const auto& one) { return theory(one, arrivals); }, law);
}

} // namespace hapnet::emulator
