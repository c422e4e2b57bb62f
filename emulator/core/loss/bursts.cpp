// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/bursts.hpp"

#include "proto/base/ensure.hpp"

namespace hapnet::emulator {

BurstJudge::BurstJudge(const Burst& law, const base::RandomStream& stream) { change(law, stream); }

LossJudgement BurstJudge::on_packet(const Packet& packet, const base::RandomStream&) const
{
    return judgement((packet.number + shift_) % law_.of < law_.lost, DropCause::burst_loss);
}

void BurstJudge::change(const Burst& law, const base::RandomStream& stream)
{
    base::ensure(law.of > 0);
    law_ = law;
    shift_ = law.phase ? law.of - *law.phase : stream.below(law.of, 0);
}

TimedBurstJudge::TimedBurstJudge(const TimedBurst& law, const base::RandomStream& stream)
{
    change(law, stream);
}

LossJudgement TimedBurstJudge::on_packet(const Packet& packet, const base::RandomStream&)
{
    const bool is_before = packet.at < begin_;
    const base::Duration since = packet.at - begin_ + (is_before ? law_.every : base::Duration{0});
    if (const auto* lost = std::get_if<base::Duration>(&law_.lost)) {
        return judgement(since % law_.every < *lost, DropCause::burst_loss);
    }
    const std::int64_t period = is_before ? -1 : since / law_.every;
    if (period != period_) {
        period_ = period;
        lost_ = 0;
    }
    const bool is_lost = !is_before && lost_ < std::get<std::uint32_t>(law_.lost);
    if (is_lost) ++lost_;
    return judgement(is_lost, DropCause::burst_loss);
}

void TimedBurstJudge::change(const TimedBurst& law, const base::RandomStream& stream)
{
    base::ensure(law.every > base::Duration{0});
    law_ = law;
    const auto every = static_cast<double>(law.every.count());
    begin_ = law.phase.value_or(
        base::Duration{static_cast<base::Duration::rep>(stream.uniform(0) * every)});
}

} // namespace hapnet::emulator
