// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "proto/base/result.hpp"

namespace hapnet::emulator {

/// Whether there is something in between `from` and what `to` sets. Between numbers of the same law
/// there is, and a share, delay, width or deviation of zero goes with any.
[[nodiscard]] base::Result<void> validate_ramp(const Conditions& from, const Patch& to);

/// `conditions` with what `to` sets, so far on the straight line from `from` to there as `progress`
/// says, from 0 to 1. Ensures that it is a valid ramp.
[[nodiscard]] Conditions ramped(Conditions conditions, const Conditions& from, const Patch& to,
                                double progress);

} // namespace hapnet::emulator
