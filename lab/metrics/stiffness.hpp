// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

namespace hapnet::lab::metrics {

/// The ratio of force to deflection at one frequency, N/m: the part in phase and the part a quarter
/// of a period ahead.
struct DynamicStiffness {
    double storage_n_per_m = 0.0;
    double loss_n_per_m = 0.0;
};

/// Returns the dynamic stiffness that a hand feels when it moves to and fro at `hertz`. It is -F /
/// X, where F is the force on the hand and X its position, both at that frequency. They are found
/// by correlation with a sine and a cosine (a lock-in amplifier) over the last whole periods of the
/// signals. The storage of a spring is its constant; that of a mass is less than 0. The loss of a
/// damper is 2 pi `hertz` times its constant. nullopt when there is less than one period, or when
/// the hand hardly moves (less than 10 um).
[[nodiscard]] std::optional<DynamicStiffness> stiffness_of(std::span<const double> force_on_hand,
                                                           std::span<const double> hip,
                                                           double hertz, double tick_s);

} // namespace hapnet::lab::metrics
