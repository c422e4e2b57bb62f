// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

namespace hapnet::lab::metrics {

/// How abruptly a force changes.
struct ForceSteps {
    double largest_n = 0.0; // in one millisecond
    /// How often a change of more than 0.5 N/ms is followed by one of the other sign; smaller ones
    /// in between do not matter.
    double reversals = 0.0;

    friend bool operator==(const ForceSteps&, const ForceSteps&) = default;
};

/// nullopt when there are less than two samples.
[[nodiscard]] std::optional<ForceSteps> force_steps_of(std::span<const double> force,
                                                       double tick_s);

} // namespace hapnet::lab::metrics
