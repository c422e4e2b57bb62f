// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/theory.hpp"

#include <algorithm>

namespace hapnet::emulator {

LossTheory theory_from_pairs(double share, double both)
{
    LossTheory theory{.share = share};
    if (share <= 0.0) return theory;
    theory.loss_after_loss = both / share;
    if (both < share) theory.mean_run = share / (share - both);
    return theory;
}

LossTheory theory_from_counts(double count, double losses, double runs)
{
    return theory_from_pairs(losses / count, (losses - runs) / count);
}

LossTheory with_memory(LossTheory theory)
{
    const double inflation = std::max(theory.variance_inflation, 1.0);
    theory.memory = (inflation - 1.0) / (inflation + 1.0);
    return theory;
}

std::optional<RunLengths> geometric_runs(double goes_on)
{
    if (!(goes_on >= 0.0 && goes_on < 1.0)) return std::nullopt;
    RunLengths runs;
    double at_least = 1.0;
    for (std::size_t i = 0; i < RunLengths::most; ++i) {
        runs.at_least.push_back(at_least);
        at_least *= goes_on;
    }
    return runs;
}

} // namespace hapnet::emulator
