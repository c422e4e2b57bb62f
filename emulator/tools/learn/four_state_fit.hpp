// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/loss/four_state.hpp"
#include "emulator/tools/learn/loss_runs.hpp"

#include <optional>
#include <vector>

namespace hapnet::emulator::tools {

/// The four-state chain under which the runs are most likely.
struct FourStateFit {
    FourState law{};
    FourStateSteps steps{};
    double log_likelihood = 0.0; // log likelihood of all runs
};

/// Fits Salsano's four states (FourState) by expectation and maximization. The likelihood is
/// computed run by run, because a run of arrivals is entirely in the gap or entirely within a
/// burst, and a run of losses is entirely isolated or within a burst. The fit starts several times:
/// fewer than 4, 16 or 64 arrivals in a row count as within a burst (RFC 3611, section 4.7.2, has
/// 16). The most likely start is iterated to convergence. At most the first 20 000 runs are used.
/// nullopt: the result is not a valid law, for example when every loss is isolated.
[[nodiscard]] std::optional<FourStateFit> fit_four_states(const std::vector<LossRun>& all);

/// Returns the law with these steps: the inverse of FourState::steps(), with rounded numbers.
[[nodiscard]] FourState law_of(const FourStateSteps& steps);

[[nodiscard]] LossChain chain_of(const FourStateSteps& steps);

} // namespace hapnet::emulator::tools
