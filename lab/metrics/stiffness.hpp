// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

namespace hapnet::lab::metrics {

/// Force against deflection at one frequency, N/m: the part in phase and the part a quarter of a
/// period ahead.
struct DynamicStiffness {
    double storage_n_per_m = 0.0;
    double loss_n_per_m = 0.0;
};

/// The dynamic stiffness that a hand feels when it moves to and fro at `hertz`: -F / X of the force
/// on the hand and of where it is, both taken at that frequency by correlation with a sine and a
/// cosine (a lock-in amplifier) over the last whole periods of the signals. A spring has its
/// constant for storage, a mass less than 0; a damper has 2 pi `hertz` times its constant for loss.
/// nullopt when less than one period is there, or when the hand hardly moves (less than 10 um).
[[nodiscard]] std::optional<DynamicStiffness> stiffness_of(std::span<const double> force_on_hand,
                                                           std::span<const double> hip,
                                                           double hertz, double tick_s);

} // namespace hapnet::lab::metrics
