// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/k_of_n.hpp"

#include "emulator/core/loss/burst.hpp"
#include "proto/base/ensure.hpp"

#include <cmath>

namespace hapnet::emulator {

base::Result<void> BlockLoss::validate() const { return Burst{lost, of, {}}.validate(); }

LossTheory BlockLoss::theory(const Arrivals& /*arrivals*/) const
{
    const double k = lost;
    const double n = of;
    // Among n neighbouring pairs, n - 1 lie within a block and one across its end.
    auto theory = theory_from_pairs(k / n, (k * (k - 1.0) / n + k * k / (n * n)) / n);
    // The variance for two sequences in blocks of n is that of independent ones times 1 + 1 / (n -
    // 1).
    theory.memory = 1.0 / std::sqrt(n);
    return theory;
}

std::vector<LossProperty> BlockLoss::properties(const RunFacts& /*facts*/) const
{
    return {ExactBlocks{lost, of}};
}

BlockLoss::Model::Model(const BlockLoss& law, const base::RandomStream& stream)
{
    change(law, stream);
}

bool BlockLoss::Model::on_packet(const Packet& packet, const base::RandomStream& stream)
{
    if (seen_ >= law_.of) seen_ = lost_ = 0;
    const double places = law_.of - seen_; // places left in the block
    const double losses = law_.lost > lost_ ? law_.lost - lost_ : 0;
    const bool is_lost = stream.uniform(packet.number) * places < losses;
    ++seen_;
    if (is_lost) ++lost_;
    return is_lost;
}

void BlockLoss::Model::change(const BlockLoss& law, const base::RandomStream& /*stream*/)
{
    base::ensure(law.of > 0);
    law_ = law;
}

} // namespace hapnet::emulator
