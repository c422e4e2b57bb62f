// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/criteria.hpp"
#include "lab/metrics/scores.hpp"
#include "proto/base/result.hpp"

#include <span>

namespace hapnet::lab::metrics {

/// The sessions of `base` that the paper found just tolerable, for every task and seed.
struct CalibrationSessions {
    std::span<const Scores> at_delay;       // one-way delay of 160 ms
    std::span<const Scores> at_random_loss; // 93 % random loss, without delay
};

/// Returns `rest` with the two numbers that are calibrated. One is the median over the seeds of the
/// vibration at the random loss (for each filter order), to the nearest hundredth of a millimetre.
/// The other is the median of the slow stiffness error at the delay, to the nearest thousandth.
/// Each is taken from the task in which it is worst. So half of that task's sessions fail there,
/// which is the definition of a limit.
///
/// Refuses sessions if none of them has a number to calibrate by. Refuses tasks in which more than
/// half of the sessions are not usable by metrics that are not calibrated.
[[nodiscard]] base::Result<Criteria> calibrated(const CalibrationSessions& sessions,
                                                const Criteria& rest);

} // namespace hapnet::lab::metrics
