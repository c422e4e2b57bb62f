// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/criteria.hpp"
#include "lab/metrics/scores.hpp"
#include "proto/base/result.hpp"

#include <span>

namespace hapnet::lab::metrics {

/// The sessions of `base` that the paper found just tolerable: of every task and seed that a limit
/// is to hold for.
struct CalibrationSessions {
    std::span<const Scores> at_delay;       // one-way delay of 160 ms
    std::span<const Scores> at_random_loss; // 93 % random loss, without delay
};

/// `rest` with the two numbers that are calibrated: the vibration of the worst session at the
/// random loss (of each filter order), rounded up to the next hundredth of a millimetre; and the
/// stiffness ratio of the softest session at the delay, rounded down to the next thousandth. So the
/// worst session just passes there, and the rounding is all the margin there is.
///
/// Refuses sessions of which none tells a number, sessions that would not be usable all the same
/// by what is not calibrated, and sessions without any stiffness left: no threshold above 0 would
/// let those pass.
[[nodiscard]] base::Result<Criteria> calibrated(const CalibrationSessions& sessions,
                                                const Criteria& rest);

} // namespace hapnet::lab::metrics
