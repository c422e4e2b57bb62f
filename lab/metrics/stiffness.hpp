// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

namespace hapnet::lab::metrics {

/// The stiffness that a hand feels when it moves to and fro at `hertz`, in N/m: -Re{F / X} of the
/// force on the hand and of where it is, both taken at that frequency by correlation with a sine
/// and a cosine (a lock-in amplifier) over the last whole periods of the signals. A spring gives
/// its constant, a damper 0, a mass less than 0. nullopt when less than one period is there, or
/// when the hand hardly moves (less than 10 um).
[[nodiscard]] std::optional<double> stiffness_of(std::span<const double> force_on_hand,
                                                 std::span<const double> hip, double hertz,
                                                 double tick_s);

} // namespace hapnet::lab::metrics
