// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/impairment.hpp"

#include "proto/base/ensure.hpp"

#include <cmath>

namespace hapnet::emulator {

ConstantDelay::ConstantDelay(base::Duration delay) : delay_{delay}
{
    base::ensure(delay >= base::Duration{0});
}

Verdict ConstantDelay::on_packet(std::uint64_t /*number*/) const { return Deliver{delay_}; }

UniformJitter::UniformJitter(base::Duration half_width, base::RandomStream stream)
    : half_width_{half_width}, stream_{stream}
{
    base::ensure(half_width >= base::Duration{0});
}

Verdict UniformJitter::on_packet(std::uint64_t number) const
{
    const double share = 2.0 * stream_.uniform(number) - 1.0;
    return Deliver{base::Duration{std::llround(share * static_cast<double>(half_width_.count()))}};
}

RandomLoss::RandomLoss(base::Probability probability, base::RandomStream stream)
    : probability_{probability}, stream_{stream}
{}

Verdict RandomLoss::on_packet(std::uint64_t number) const
{
    if (stream_.uniform(number) < probability_.fraction()) return Drop{DropCause::random_loss};
    return Deliver{};
}

BurstLoss::BurstLoss(Burst burst, const base::RandomStream& stream)
    : burst_{burst}, phase_{stream.below(burst.of, 0)}
{
    base::ensure(0 < burst.lost && burst.lost <= burst.of);
}

Verdict BurstLoss::on_packet(std::uint64_t number) const
{
    if ((number + phase_) % burst_.of < burst_.lost) return Drop{DropCause::burst_loss};
    return Deliver{};
}

} // namespace hapnet::emulator
