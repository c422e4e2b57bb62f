// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/recorded.hpp"

#include "emulator/core/loss/trace.hpp"
#include "proto/base/ensure.hpp"

namespace hapnet::emulator {

LossJudgement ListJudge::on_packet(const Packet& packet, const base::RandomStream&)
{
    const auto& numbers = law_.numbers;
    while (next_ < numbers.size() && numbers[next_] < packet.number) ++next_;
    return judgement(next_ < numbers.size() && numbers[next_] == packet.number,
                     DropCause::listed_loss);
}

void ListJudge::change(const ListedLoss& law, const base::RandomStream&)
{
    if (law == law_) return;
    law_ = law;
    next_ = 0;
}

PatternJudge::PatternJudge(const PatternLoss& law, const base::RandomStream& stream)
{
    change(law, stream);
}

LossJudgement PatternJudge::on_packet(const Packet& packet, const base::RandomStream&) const
{
    return judgement(law_.pattern[packet.number % law_.pattern.size()], DropCause::pattern_loss);
}

void PatternJudge::change(const PatternLoss& law, const base::RandomStream&)
{
    base::ensure(!law.pattern.empty());
    if (law != law_) law_ = law;
}

TraceJudge::TraceJudge(const TraceLoss& law, const base::RandomStream& stream)
{
    change(law, stream);
}

LossJudgement TraceJudge::on_packet(const Packet& packet, const base::RandomStream&) const
{
    return judgement(trace_->is_lost(packet.number), DropCause::trace_loss);
}

void TraceJudge::change(const TraceLoss& law, const base::RandomStream&)
{
    base::ensure(law.trace != nullptr);
    trace_ = law.trace;
}

LossJudgement OutageJudge::on_packet(const Packet& packet, const base::RandomStream&)
{
    const auto& windows = law_.windows;
    while (next_ < windows.size() && windows[next_].to <= packet.at) ++next_;
    return judgement(next_ < windows.size() && windows[next_].from <= packet.at, DropCause::outage);
}

void OutageJudge::change(const Outage& law, const base::RandomStream&)
{
    if (law == law_) return;
    law_ = law;
    next_ = 0;
}

} // namespace hapnet::emulator
