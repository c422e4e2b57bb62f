// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"

#include <optional>
#include <string>

namespace hapnet::emulator {

/// Why there is nothing in between `from` and what `to` sets, in words that say what would be
/// right; nullopt: the one can be approached from the other. Numbers of the same law can, and a
/// share, delay, width or deviation of zero goes with any.
[[nodiscard]] std::optional<std::string> ramp_fault(const Conditions& from, const Patch& to);

/// `conditions` with what `to` sets, so far on the straight line from `from` to there as `progress`
/// says, from 0 to 1. Ensures that there is no ramp_fault.
[[nodiscard]] Conditions ramped(Conditions conditions, const Conditions& from, const Patch& to,
                                double progress);

} // namespace hapnet::emulator
