// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/list.hpp"

#include <algorithm>
#include <functional>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

base::Result<void> ListedLoss::validate() const
{
    const auto wrong = std::adjacent_find(numbers.begin(), numbers.end(), std::greater_equal<>{});
    if (wrong == numbers.end()) return {};
    return base::fail(
        fmt::format("the numbers must ascend, but {} comes before {}", *wrong, *(wrong + 1)));
}

LossTheory ListedLoss::theory(const Arrivals& arrivals) const
{
    double losses = 0.0;
    double runs = 0.0;
    for (std::size_t i = 0; i < numbers.size() && numbers[i] < arrivals.count; ++i) {
        losses += 1.0;
        if (i == 0 || numbers[i - 1] + 1 != numbers[i]) runs += 1.0;
    }
    return theory_from_counts(static_cast<double>(arrivals.count), losses, runs);
}

std::vector<LossProperty> ListedLoss::properties(const RunFacts& facts) const
{
    return {same_losses(*this, facts.count)};
}

bool ListedLoss::Model::on_packet(const Packet& packet, const base::RandomStream& /*stream*/)
{
    const auto& lost = law_.numbers.get();
    // After a change the next listed number may be far away.
    if (next_ < lost.size() && lost[next_] < packet.number) {
        const auto from = lost.begin() + static_cast<std::ptrdiff_t>(next_);
        const auto place = std::lower_bound(from, lost.end(), packet.number);
        next_ = static_cast<std::size_t>(place - lost.begin());
    }
    return next_ < lost.size() && lost[next_] == packet.number;
}

void ListedLoss::Model::change(const ListedLoss& law, const base::RandomStream& /*stream*/)
{
    if (law == law_) return;
    law_ = law;
    next_ = 0;
}

} // namespace hapnet::emulator
