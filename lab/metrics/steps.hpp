// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"

#include <optional>
#include <span>

namespace hapnet::lab::metrics {

/// The abruptness of a force's changes.
struct ForceSteps {
    double largest_n = 0.0; // largest change in one millisecond
    /// The number of changes of more than 0.5 N/ms that are followed by one of the other sign.
    /// Smaller changes in between do not matter.
    double reversals = 0.0;

    friend bool operator==(const ForceSteps&, const ForceSteps&) = default;
};
constexpr auto fields_of(base::Tag<ForceSteps>)
{
    return base::fields(
        "force steps",
        base::member("largest_n", &ForceSteps::largest_n, "The largest change in a millisecond."),
        base::member("reversals", &ForceSteps::reversals,
                     "How often a change of more than 0.5 N/ms is followed by one "
                     "of the other sign."));
}

/// Returns nullopt for fewer than two samples.
[[nodiscard]] std::optional<ForceSteps> force_steps_of(std::span<const double> force,
                                                       double tick_s);

} // namespace hapnet::lab::metrics
