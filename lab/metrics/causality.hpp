// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/columns.hpp"

#include <optional>

namespace hapnet::lab::metrics {

/// Returns the time, in seconds, until one side's push moves the other side's body: from the first
/// tick of a touch until the other side's copy moves faster than 20 mm/s. It is the mean over all
/// touches before which the pusher has not touched for 100 ms and the other side's copy has been
/// slower than that for 50 ms. A touch that moves nothing within 0.6 s does not count. The time
/// includes the time that the body takes to become so fast. nullopt when there is no such touch.
[[nodiscard]] std::optional<double> response_of(const Columns& pusher, const Columns& other,
                                                double tick_s);

} // namespace hapnet::lab::metrics
