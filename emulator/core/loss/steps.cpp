// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/steps.hpp"

#include "proto/base/math.hpp"

namespace hapnet::emulator {

TwoStateSteps steps_of(const Gilbert& law)
{
    const double share = law.share.fraction();
    return {.good_to_bad = share / ((1.0 - share) * law.mean_burst),
            .bad_to_good = 1.0 / law.mean_burst,
            .loss_good = 0.0,
            .loss_bad = 1.0};
}

TwoStateSteps steps_of(const GilbertElliott& law)
{
    return {.good_to_bad = law.good_to_bad.fraction(),
            .bad_to_good = law.bad_to_good.fraction(),
            .loss_good = law.loss_good.fraction(),
            .loss_bad = law.loss_bad.fraction()};
}

TwoStateSteps steps_of(const TimedGilbertElliott& law, base::Duration after)
{
    // Of a chain in continuous time with the rates 1 / mean_good and 1 / mean_bad.
    const auto good = static_cast<double>(law.mean_good.count());
    const auto bad = static_cast<double>(law.mean_bad.count());
    const double bad_share = bad / (good + bad);
    const auto passed = static_cast<double>(after.count());
    const double forgotten = 1.0 - base::exp(-(passed / good + passed / bad));
    return {.good_to_bad = bad_share * forgotten,
            .bad_to_good = (1.0 - bad_share) * forgotten,
            .loss_good = law.loss_good.fraction(),
            .loss_bad = law.loss_bad.fraction()};
}

FourStateSteps steps_of(const FourState& law)
{
    const double share = law.share.fraction();
    const double density = law.density.fraction();
    const double isolated = law.isolated.fraction();
    const double good_run_to_burst = 1.0 / law.good_run;
    return {.gap_to_burst = (share - isolated) / (law.burst * (1.0 - isolated) * (density - share)),
            .gap_to_isolated = isolated / (1.0 - isolated),
            .burst_to_gap = 1.0 / (density * law.burst),
            .burst_to_good_run = good_run_to_burst * (1.0 - density) / density,
            .good_run_to_burst = good_run_to_burst};
}

FourStateSteps::Shares FourStateSteps::shares() const
{
    const double lost_per_gap = gap_to_burst / burst_to_gap;
    const double good_per_gap = lost_per_gap * burst_to_good_run / good_run_to_burst;
    const double gap = 1.0 / (1.0 + lost_per_gap + good_per_gap + gap_to_isolated);
    return {.received_in_gap = gap,
            .received_in_burst = gap * good_per_gap,
            .lost_in_burst = gap * lost_per_gap,
            .lost_in_gap = gap * gap_to_isolated};
}

} // namespace hapnet::emulator
