// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/periodic.hpp"

#include "proto/base/ensure.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

base::Result<void> PeriodicLoss::validate() const
{
    if (every == 0) return base::fail("cannot lose every 0th datagram: write 1 or more");
    if (phase < every) return {};
    return base::fail(
        fmt::format("phase {} is outside the period: write 0 to {}", phase, every - 1));
}

LossTheory PeriodicLoss::theory(const Arrivals& /*arrivals*/) const
{
    return theory_from_counts(every, 1.0, every > 1 ? 1.0 : 0.0);
}

std::vector<LossProperty> PeriodicLoss::properties(const RunFacts& facts) const
{
    return {same_losses(*this, facts.count)};
}

PeriodicLoss::Model::Model(const PeriodicLoss& law, const base::RandomStream& stream)
{
    change(law, stream);
}

void PeriodicLoss::Model::change(const PeriodicLoss& law, const base::RandomStream& /*stream*/)
{
    base::ensure(law.every > 0);
    law_ = law;
}

} // namespace hapnet::emulator
