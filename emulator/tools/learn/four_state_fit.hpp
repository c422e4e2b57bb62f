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
/// the likelihood is computed run by run. The fit starts several times: fewer than 4, 16 or 64
/// arrivals in a row count as within a burst (RFC 3611, section 4.7.2, has 16). The most likely
/// start is iterated to its end. At most the first 20 000 runs are used. nullopt: the result is no
/// law, for example when every loss is isolated.
[[nodiscard]] std::optional<FourStateFit> fit_four_states(const std::vector<LossRun>& all);

/// The law with these steps: the inverse of FourState::steps(), with rounded numbers.
[[nodiscard]] FourState law_of(const FourStateSteps& steps);

[[nodiscard]] LossChain chain_of(const FourStateSteps& steps);

} // namespace hapnet::emulator::tools
