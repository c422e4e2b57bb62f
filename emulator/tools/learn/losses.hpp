// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/loss/loss.hpp"
#include "emulator/tools/learn/loss_runs.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace hapnet::emulator::tools {

/// A model of losses with the parameters under which the measured losses are most likely.
struct LossModel {
    std::string_view name;
    LossLaw law;
    LossChain chain{}; // the law as a chain of states
    double log_likelihood = 0.0;
    int parameters = 0;
    double bic = 0.0; // less is better (Schwarz, Annals of Statistics 6, 1978)

    // The goodness of fit (see test_runs); nullopt: too few runs.
    std::optional<double> losses_p_value{};
    std::optional<double> arrivals_p_value{};
};

/// Fits independent losses, Gilbert, Gilbert-Elliott (Baum and Welch's iteration) and four states.
/// Returns them with the best by BIC first; empty when nothing was lost. A model whose parameters
/// are not valid is left out.
[[nodiscard]] std::vector<LossModel> fit_losses(const std::vector<bool>& lost);

} // namespace hapnet::emulator::tools
