// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/process.hpp"

#include "proto/base/ensure.hpp"

namespace hapnet::emulator {

bool operator==(const TraceLoss& a, const TraceLoss& b)
{
    return a.file == b.file && a.trace == b.trace;
}

std::string_view name_of(const LossLaw& law)
{
    return std::holds_alternative<RandomLoss>(law) ? "random" : "burst";
}

LossProcess::LossProcess(const LossLaw& law, const base::RandomStream& stream)
    : law_{law}, stream_{stream}
{}

LossJudgement LossProcess::on_packet(const Packet& packet)
{
    if (const auto* random = std::get_if<RandomLoss>(&law_)) {
        if (stream_.uniform(packet.number) >= random->share.fraction()) return {};
        return {DropCause::random_loss};
    }
    const auto* burst = std::get_if<Burst>(&law_);
    base::ensure(burst != nullptr);
    const std::uint64_t phase = burst->phase ? *burst->phase : stream_.below(burst->of, 0);
    if ((packet.number + phase) % burst->of >= burst->lost) return {};
    return {DropCause::burst_loss};
}

void LossProcess::change(const LossLaw& law) { law_ = law; }

} // namespace hapnet::emulator
