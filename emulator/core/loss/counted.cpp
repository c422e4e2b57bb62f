// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/counted.hpp"

#include "proto/base/ensure.hpp"

namespace hapnet::emulator {

LossJudgement RandomJudge::on_packet(const Packet& packet, const base::RandomStream& stream) const
{
    return judgement(stream.uniform(packet.number) < law_.share.fraction(), DropCause::random_loss);
}

BlockJudge::BlockJudge(const BlockLoss& law, const base::RandomStream&) : law_{law}
{
    base::ensure(law.of > 0);
}

LossJudgement BlockJudge::on_packet(const Packet& packet, const base::RandomStream& stream)
{
    if (seen_ >= law_.of) seen_ = lost_ = 0;
    const double places = law_.of - seen_; // that are left in the block
    const double losses = law_.lost > lost_ ? law_.lost - lost_ : 0;
    const bool is_lost = stream.uniform(packet.number) * places < losses;
    ++seen_;
    if (is_lost) ++lost_;
    return judgement(is_lost, DropCause::block_loss);
}

void BlockJudge::change(const BlockLoss& law, const base::RandomStream&)
{
    base::ensure(law.of > 0);
    law_ = law;
}

PeriodicJudge::PeriodicJudge(const PeriodicLoss& law, const base::RandomStream&) : law_{law}
{
    base::ensure(law.every > 0);
}

LossJudgement PeriodicJudge::on_packet(const Packet& packet, const base::RandomStream&) const
{
    return judgement(packet.number % law_.every == law_.phase, DropCause::periodic_loss);
}

void PeriodicJudge::change(const PeriodicLoss& law, const base::RandomStream&)
{
    base::ensure(law.every > 0);
    law_ = law;
}

} // namespace hapnet::emulator
