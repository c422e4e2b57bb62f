// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/session/guarded_play.hpp"

#include "tests/sim/peer/core/score.hpp"

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>
#include <vector>

namespace hapnet::test {

using namespace std::chrono_literals;
using lab::virtual_time::VirtualPlayer;
using lab::virtual_time::VirtualWorld;

HandEnergy::HandEnergy(const VirtualPlayer& player)
    : hip_{player.side->sample().hip}, held_{player.told()}, observer_{{}, 1ms}
{}

void HandEnergy::add(const VirtualPlayer& player, base::TimePoint now)
{
    const base::Position hip = player.side->sample().hip;
    observer_.pass(held_, hip, 1ms);
    work_.add(glm::dot(held_.value, (hip - hip_).value), now);
    hip_ = hip;
    held_ = player.told();
}

double HandEnergy::power_w() const { return observer_.figures().power_max_w; }

GuardedPlay play_guarded(const lab::virtual_time::Setting& setting)
{
    VirtualWorld world{setting};
    sim::run_until_started(world);
    sim::Hash hash;
    std::vector<HandEnergy> hands;
    for (std::size_t i = 0; i < world.sides(); ++i) hands.emplace_back(world.side(i));
    while (world.side(0).last().phase != peer::Phase::ended) {
        world.step();
        for (std::size_t i = 0; i < world.sides(); ++i) {
            hash.add(world, i);
            hands[i].add(world.side(i), world.now());
        }
    }
    GuardedPlay played{.hash = hash.value()};
    for (std::size_t i = 0; i < world.sides(); ++i) {
        const device::Governor& governor = world.side(i).rig.governor();
        played.limited += governor.counters().energy_limited;
        if (governor.energy() != nullptr) ++played.guarded_hands;
        played.work_5s_j = std::max(played.work_5s_j, hands[i].work_5s_j());
        played.power_w = std::max(played.power_w, hands[i].power_w());
    }
    return played;
}

} // namespace hapnet::test
