// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "proto/base/result.hpp"

namespace hapnet::emulator {

/// Refuses a ramp without intermediate values. Intermediate values exist between numbers of the
/// same law. A share, delay, width or deviation of zero is compatible with any law.
[[nodiscard]] base::Result<void> validate_ramp(const Conditions& from, const Patch& to);

/// Returns `conditions` with the settings of `to`, at the share `progress` (0 to 1) of the straight
/// line from `from` to `to`. Ensures that the ramp is valid.
[[nodiscard]] Conditions ramped(Conditions conditions, const Conditions& from, const Patch& to,
                                double progress);

} // namespace hapnet::emulator
