// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/learn/learned_regime.hpp"

#include "emulator/tools/learn/likeness.hpp"

#include <algorithm>
#include <cmath>
#include <spdlog/fmt/fmt.h>
#include <vector>

namespace hapnet::emulator::tools {

namespace {

/// Returns the delays of the datagrams that arrived, in ms.
std::vector<double> delays_ms(const MeasuredWay& own)
{
    std::vector<double> values;
    for (const auto& delay : own.delays) {
        if (delay) values.push_back(base::to_nanoseconds(*delay) / 1e6);
    }
    return values;
}

/// Returns the number of independent delays that determine the mean as precisely as `count`
/// neighbours of a first-order autoregressive process with this correlation time.
double independent(double count, base::Duration time, base::Duration spacing)
{
    if (time > base::Duration{0}) {
        const double rho = std::exp(-base::to_seconds(spacing) / base::to_seconds(time));
        count *= (1.0 - rho) / (1.0 + rho);
    }
    return std::max(count, 1.0);
}

} // namespace

LearnedRegime learned_regime(const Regime& regime, const RegimeFit& fit, const MeasuredWay& own,
                             bool with_losses)
{
    const double stay = base::to_seconds(regime.stay);
    const double factor = std::exp(standard_errors_95 / std::sqrt(fit.exits));
    LearnedRegime found{.name = regime.name,
                        .stays = fit.exits,
                        .stay_s = {stay, stay / factor, stay * factor},
                        .loss = {},
                        .delay_ms = {},
                        .delay_sd_ms = {}};
    if (with_losses) {
        const double share = fit.lost / fit.rows;
        const auto [low, high] = wilson_interval(share, fit.rows);
        found.loss = Estimate{share, low, high};
    }
    const auto values = delays_ms(own);
    const auto count = static_cast<double>(values.size());
    double mean = 0.0;
    for (const double value : values) mean += value / count;
    double variance = 0.0;
    double fourth = 0.0;
    for (const double value : values) {
        const double squared = (value - mean) * (value - mean);
        variance += squared / count;
        fourth += squared * squared / count;
    }
    const auto time = regime.own.jitter ? regime.own.jitter->correlation_time : base::Duration{};
    const double n = independent(count, time, own.spacing.value_or(base::Duration{0}));
    const double sd = std::sqrt(variance);
    const double mean_error = sd / std::sqrt(n);
    // The error of a deviation, from the fourth moment (delta method).
    const double excess =
        variance > 0.0 ? std::max(fourth / (variance * variance) - 1.0, 0.0) : 0.0;
    const double sd_error = 0.5 * sd * std::sqrt(excess / n);
    const double mean_half = standard_errors_95 * mean_error;
    const double sd_half = standard_errors_95 * sd_error;
    found.delay_ms = {mean, mean - mean_half, mean + mean_half};
    found.delay_sd_ms = {sd, std::max(sd - sd_half, 0.0), sd + sd_half};
    return found;
}

std::string in_words(const LearnedRegime& regime)
{
    const Estimate& stay = regime.stay_s;
    auto text = fmt::format("regime {}: {:.0f} stays of {:.4g} s (95 %: {:.4g} to {:.4g} s)",
                            regime.name, regime.stays, stay.value, stay.low, stay.high);
    if (regime.loss) {
        text +=
            fmt::format(", loss {:.4g} % (95 %: {:.4g} to {:.4g} %)", 100.0 * regime.loss->value,
                        100.0 * regime.loss->low, 100.0 * regime.loss->high);
    }
    const auto& [delay, low, high] = regime.delay_ms;
    const auto& [sd, sd_low, sd_high] = regime.delay_sd_ms;
    return text + fmt::format(", delay {:.6g} ms (95 %: {:.6g} to {:.6g} ms), sd {:.4g} ms (95 %: "
                              "{:.4g} to {:.4g} ms)",
                              delay, low, high, sd, sd_low, sd_high);
}

} // namespace hapnet::emulator::tools
