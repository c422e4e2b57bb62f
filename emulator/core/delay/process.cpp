// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/process.hpp"

#include "proto/base/ensure.hpp"

#include <cmath>

namespace hapnet::emulator {

DelayProcess::DelayProcess(const Variation& variation, const base::RandomStream& stream)
    : variation_{variation}, stream_{stream}
{}

base::Duration DelayProcess::on_packet(const Packet& packet)
{
    if (const auto* constant = std::get_if<ConstantLaw>(&variation_.law)) return constant->value;
    const auto* uniform = std::get_if<UniformLaw>(&variation_.law);
    base::ensure(uniform != nullptr);
    const double share = 2.0 * stream_.uniform(packet.number) - 1.0;
    const auto width = static_cast<double>(uniform->half_width.count());
    return uniform->mean + base::Duration{std::llround(share * width)};
}

void DelayProcess::change(const Variation& variation) { variation_ = variation; }

} // namespace hapnet::emulator
