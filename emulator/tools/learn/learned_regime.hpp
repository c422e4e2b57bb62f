// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/tools/learn/measurement.hpp"
#include "emulator/tools/learn/regimes_fit.hpp"
#include "proto/base/describe.hpp"

#include <optional>
#include <string>

namespace hapnet::emulator::tools {

/// A value with its 95 % interval.
struct Estimate {
    double value = 0.0;
    double low = 0.0;
    double high = 0.0;
};
constexpr auto fields_of(base::Tag<Estimate>)
{
    using E = Estimate;
    return base::fields("estimate", base::member("value", &E::value, "The estimate."),
                        base::member("low", &E::low, "Lower end of its 95 % interval."),
                        base::member("high", &E::high, "Upper end."));
}

/// The figures of one regime that was found in a series.
struct LearnedRegime {
    std::string name;
    double stays = 0.0; // expected number
    Estimate stay_s;
    std::optional<Estimate> loss; // share; nullopt: losses are described in another form
    Estimate delay_ms;
    Estimate delay_sd_ms;
};
constexpr auto fields_of(base::Tag<LearnedRegime>)
{
    using L = LearnedRegime;
    return base::fields(
        "learned regime", base::member("name", &L::name, "Its name in the profile."),
        base::member("stays", &L::stays, "Expected number of its stays in the series."),
        base::member("stay_s", &L::stay_s, "The mean length of a stay."),
        base::member("loss", &L::loss,
                     "The share of its datagrams that are lost. null: the file does not say on "
                     "which way they were lost, and they are put into the other."),
        base::member("delay_ms", &L::delay_ms, "The mean delay of its datagrams."),
        base::member("delay_sd_ms", &L::delay_sd_ms, "The standard deviation of these delays."));
}

/// Returns the figures of a regime. `own` are the rows that were found to be in it, each at its
/// position in the series. The intervals are those of independent stays, of independent losses, and
/// of delays with the correlation time of the regime.
[[nodiscard]] LearnedRegime learned_regime(const Regime& regime, const RegimeFit& fit,
                                           const MeasuredWay& own, bool with_losses);

/// Returns the figures in one line, for people.
[[nodiscard]] std::string in_words(const LearnedRegime& regime);

} // namespace hapnet::emulator::tools
