// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/loss/four_state.hpp"
#include "emulator/tools/learn/loss_runs.hpp"

#include <optional>
#include <vector>

namespace hapnet::emulator::tools {

/// The four-state chain under which runs are most likely.
struct FourStateFit {
    FourState law{};
    FourStateSteps steps{};
    double log_likelihood = 0.0; // log likelihood of all runs
};

/// Fits Salsano's four states (FourState) by expectation and maximization. As a run of arrivals is
/// wholly in the gap or wholly within a burst, and a run of losses wholly isolated or in a burst,
/// the chain is summed run by run. Several starts tell bursts by arrivals of fewer than 4, 16 or 64
/// in a row (16 is that of RFC 3611, section 4.7.2); the most likely one is followed to its end. At
/// most the first 20 000 runs are fitted to. nullopt: what was found makes no law, as when all
/// losses are alone.
[[nodiscard]] std::optional<FourStateFit> fit_four_states(const std::vector<LossRun>& all);

/// The law with these steps: the inverse of FourState::steps(), with rounded numbers.
[[nodiscard]] FourState law_of(const FourStateSteps& steps);

[[nodiscard]] LossChain chain_of(const FourStateSteps& steps);

} // namespace hapnet::emulator::tools
