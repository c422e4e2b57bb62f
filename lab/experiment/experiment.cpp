// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/experiment/experiment.hpp"

#include "lab/experiment/fields.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::lab::experiment {

device::Operator hand_of_people()
{
    device::Operator person = *device::operator_named("nominal");
    person.wander.amplitude_m = 0.0;
    return person;
}

std::string name_of(const Hands& hands)
{
    if (hands.people) return hands.people->name();
    if (hands.left == hands.right) return hands.left.name;
    return hands.left.name + "/" + hands.right.name;
}

std::vector<SearchRange> ranges_of(const Limits& limits)
{
    std::vector<SearchRange> ranges;
    base::for_each_field(
        [&](const auto& /*field*/, const auto& range) {
            if (range) ranges.push_back(*range);
        },
        limits.ranges);
    return ranges;
}

base::Duration session_length(double end_s)
{
    using namespace std::chrono_literals;
    const auto hands_on =
        std::chrono::milliseconds{static_cast<std::int64_t>(std::ceil(1e3 * end_s - 1e-6))};
    return hands_on + std::min<base::Duration>(3s, hands_on);
}

std::vector<Party> parties_of(const Experiment& experiment)
{
    std::vector<Party> parties;
    for (const std::uint32_t peers : experiment.peers) {
        if (experiment.scenes.empty()) parties.push_back({.peers = peers});
        for (std::size_t i = 0; i < experiment.scenes.size(); ++i) parties.push_back({peers, i});
    }
    return parties;
}

std::string_view name_of(const Kind& kind)
{
    return std::visit([]<typename One>(const One&) { return base::described_name<One>; }, kind);
}

} // namespace hapnet::lab::experiment
