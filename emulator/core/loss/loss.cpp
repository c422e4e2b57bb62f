// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/loss.hpp"

#include "proto/base/ensure.hpp"

namespace hapnet::emulator {

template class LossProcessOf<LossLaw>;

std::string_view name_of(const LossLaw& law)
{
    return std::visit([]<typename Law>(const Law&) { return base::described_name<Law>; }, law);
}

base::Result<void> validate(const LossLaw& law)
{
    return std::visit([](const auto& one) { return one.validate(); }, law);
}

bool is_in_time(const LossLaw& law)
{
    return std::visit([]<typename Law>(const Law&) { return Law::is_in_time; }, law);
}

LossTheory theory_of(const LossLaw& law, const Arrivals& arrivals)
{
    base::ensure(arrivals.spacing > base::Duration{0} && arrivals.count > 0);
    return std::visit([&](const auto& one) { return one.theory(arrivals); }, law);
}

std::vector<LossProperty> properties_of(const LossLaw& law, const RunFacts& facts)
{
    return std::visit([&](const auto& one) { return one.properties(facts); }, law);
}

} // namespace hapnet::emulator
