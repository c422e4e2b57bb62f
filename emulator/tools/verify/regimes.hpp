// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/core/fate.hpp"
#include "emulator/tools/verify/result.hpp"
#include "proto/base/time.hpp"

#include <optional>
#include <span>
#include <vector>

namespace hapnet::emulator::tools {

/// Returns a matrix: [i][j] is the probability that regime j is in effect a time `after` regime i
/// was, whatever came in between. It is the exponential of the chain's rates times that time.
/// `after` >= 0.
[[nodiscard]] std::vector<std::vector<double>> passages_of(std::span<const Regime> regimes,
                                                           base::Duration after);

/// Tests the regimes of a direction by the regime of each fate: their lengths, their order, and the
/// laws within each. `conditions` has regimes.
[[nodiscard]] std::vector<TestResult> verify_regimes(const Conditions& conditions,
                                                     std::span<const Fate> fates,
                                                     std::optional<base::Duration> spacing,
                                                     double alpha);

} // namespace hapnet::emulator::tools
