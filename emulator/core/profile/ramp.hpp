// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "proto/base/result.hpp"

namespace hapnet::emulator {

/// Refuses a ramp without values in between. There are values between numbers of the same law. A
/// share, delay, width or deviation of zero goes with any law.
[[nodiscard]] base::Result<void> validate_ramp(const Conditions& from, const Patch& to);

/// Returns `conditions` with the settings of `to`, at the share `progress` (0 to 1) of the straight
/// line from `from` to there. Ensures that it is a valid ramp.
[[nodiscard]] Conditions ramped(Conditions conditions, const Conditions& from, const Patch& to,
                                double progress);

} // namespace hapnet::emulator
