// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/core/metrics/columns.hpp"

#include <optional>

namespace hapnet::lab {

/// How long it takes, in seconds, until a push by one side moves the other side's body: from the
/// first tick of a touch until the other's copy has moved by 0.1 mm; the mean over all touches
/// by either side that begin while both copies are at rest (less than 0.02 mm in the last 10 ms)
/// and nobody else touches. A touch that moves nothing within 1 s does not count. It contains the
/// time that the body takes to move at all. nullopt when there is no such touch.
[[nodiscard]] std::optional<double> response_of(const Columns& left, const Columns& right,
                                                double tick_s);

} // namespace hapnet::lab
