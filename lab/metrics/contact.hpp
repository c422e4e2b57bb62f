// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/columns.hpp"

#include <cstdint>
#include <optional>
#include <span>

namespace hapnet::lab::metrics {

/// Returns the mean ||F_L| - |F_R|| over the mean of all the forces, both over the ticks in which
/// both hands touch, at equal times. No delay is compensated, as the two persons do not know of
/// any. 0: they push equally. nullopt when they never both touch.
[[nodiscard]] std::optional<double> force_discrepancy_of(const Columns& left, const Columns& right);

/// Returns the share of the samples, 0 to 1, in which a push is less than 0.02 N. nullopt when
/// there are no samples.
[[nodiscard]] std::optional<double> contact_lost_of(std::span<const double> push);

/// Returns the mean |force on the hand|, in newtons, while the hand moves at 0.08 to 0.12 m/s in x
/// (over 20 ms) and touches. It is the effort of carrying. nullopt when these times together are
/// less than 0.1 s.
[[nodiscard]] std::optional<double> drag_of(const Columns& side, double tick_s);

} // namespace hapnet::lab::metrics
