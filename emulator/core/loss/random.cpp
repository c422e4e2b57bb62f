// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/random.hpp"

namespace hapnet::emulator {

LossTheory RandomLoss::theory(const Arrivals& /*arrivals*/) const
{
    const double lost = share.fraction();
    auto theory = theory_from_pairs(lost, lost * lost);
    theory.decay = 0.0;
    theory.variance_inflation = 1.0;
    return with_memory(theory);
}

std::vector<LossProperty> RandomLoss::properties(const RunFacts& /*facts*/) const
{
    std::vector<LossProperty> properties{IndependentLosses{share.fraction()}};
    if (share.fraction() <= 0.0) return properties;
    if (auto runs = geometric_runs(share.fraction())) properties.emplace_back(*std::move(runs));
    return properties;
}

} // namespace hapnet::emulator
