// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/session_spec.hpp"
#include "lab/metrics/criteria.hpp"

#include <atomic>
#include <chrono>

namespace hapnet::lab::experiment {

/// Vibration up to 0.95 mm is usable, with any filter and any distance of the copies.
inline metrics::Criteria known_criteria()
{
    metrics::Criteria criteria;
    criteria.usable.vibration_max_m = {.first = 0.95e-3, .second = 0.95e-3, .fourth = 0.95e-3};
    criteria.usable.discrepancy_max_m = criteria.good.discrepancy_max_m = 1.0;
    return criteria;
}

/// The mean delay of a session's way up, ms.
inline double delay_ms(const SessionSpec& spec)
{
    const auto* constant =
        std::get_if<emulator::ConstantLaw>(&spec.setting.profile.path.up.delay.law);
    return constant == nullptr ? 0.0 : 1e3 * base::to_seconds(constant->value);
}

/// A session with a known outcome: with the first-order filter it vibrates 9.99 um for every
/// millisecond of delay, with the second-order one half as much, with the fourth-order one a fifth,
/// and 1 % more from seed to seed. So it is usable up to 0.95 mm: at seed 1 up to 95 ms, at seed 3
/// up to 93. Seed 1001 is like seed 1.
inline PlayedSession known_session(const SessionSpec& spec)
{
    const double seed = static_cast<double>((spec.setting.seed.value() - 1) % 1000 + 1);
    const double vibration_m = 9.99e-6 * delay_ms(spec) * (1.0 + 0.01 * (seed - 1.0));
    PlayedSession played;
    played.metrics.task = spec.setting.task;
    played.metrics.scored_s = 27.0;
    played.metrics.body_vibration_m[0] =
        metrics::ByOrder{vibration_m, vibration_m / 2.0, vibration_m / 5.0};
    played.metrics.discrepancy_m =
        metrics::Spread{1e-4 * delay_ms(spec), 0.0, 3e-4 * delay_ms(spec), 1e-4};
    if (spec.rows_per_s > 0) played.rows = "0.0000,1,2,3,4,5,6,7,8,9,10,11,12,13,14\n";
    return played;
}

} // namespace hapnet::lab::experiment
