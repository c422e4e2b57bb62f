// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// The work of a tick stays within the bound of freeze(), in any scene. 100 000 scenes:
// HAPNET_COST_SCENES=100000.
#include "tests/support/scene/random_play.hpp"

#include <cstdlib>
#include <gtest/gtest.h>

namespace hapnet::test {
namespace {

std::uint64_t scenes()
{
    const char* const asked = std::getenv("HAPNET_COST_SCENES");
    return asked != nullptr ? std::strtoull(asked, nullptr, 10) : 300;
}

TEST(CostOfATick, StaysWithinTheBoundOfItsScene)
{
    constexpr std::uint64_t first = 400'000;
    scene::TickCost most; // the sum over all scenes of the most of each
    for (std::uint64_t seed = first; seed < first + scenes(); ++seed) {
        const RandomPlay play = random_play(seed);
        auto world = scene::World::freeze(play.description, play.options);
        ASSERT_TRUE(world) << world.error().message;
        const scene::TickCost bound = world->tick_cost_bound();
        for (const TickInputs& inputs : play.ticks) {
            feed(*world, inputs);
            world->tick();
            const scene::TickCost& cost = world->tick_cost();
            ASSERT_TRUE(cost.is_within(bound))
                << "seed " << seed << " tick " << world->ticks() << ": pairs " << cost.pairs
                << " of " << bound.pairs << ", contacts " << cost.contacts << " of "
                << bound.contacts << ", visits " << cost.visits << " of " << bound.visits
                << ", spring rows " << cost.spring_rows << " of " << bound.spring_rows
                << ", events " << cost.events << " of " << bound.events << ", looks " << cost.looks
                << " of " << bound.looks;
            most.pairs = std::max(most.pairs, cost.pairs);
            most.contacts = std::max(most.contacts, cost.contacts);
            most.visits = std::max(most.visits, cost.visits);
            most.spring_rows = std::max(most.spring_rows, cost.spring_rows);
            most.events = std::max(most.events, cost.events);
            most.looks = std::max(most.looks, cost.looks);
        }
    }
    // The work was counted.
    EXPECT_GT(most.pairs, 0U);
    EXPECT_GT(most.contacts, 0U);
    EXPECT_GT(most.visits, 0U);
    EXPECT_GT(most.spring_rows, 0U);
    EXPECT_GT(most.events, 0U);
    EXPECT_GT(most.looks, 0U);
}

} // namespace
} // namespace hapnet::test
