// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// What a tick takes stays within what freeze() derived, whatever the scene. 100 000 scenes:
// HAPNET_WORK_SCENES=100000.
#include "tests/support/scene/random_play.hpp"

#include <cstdlib>
#include <gtest/gtest.h>

namespace hapnet::test {
namespace {

std::uint64_t scenes()
{
    const char* const asked = std::getenv("HAPNET_WORK_SCENES");
    return asked != nullptr ? std::strtoull(asked, nullptr, 10) : 300;
}

TEST(WorkOfATick, StaysWithinTheBoundOfItsScene)
{
    constexpr std::uint64_t first = 400'000;
    scene::Work most; // the sum over all scenes of the most of each
    for (std::uint64_t seed = first; seed < first + scenes(); ++seed) {
        const RandomPlay play = random_play(seed);
        auto world = scene::World::freeze(play.description, play.options);
        ASSERT_TRUE(world) << world.error().message;
        const scene::Work bound = world->work_bound();
        for (const TickInputs& inputs : play.ticks) {
            feed(*world, inputs);
            world->tick();
            const scene::Work& work = world->work();
            ASSERT_TRUE(work.is_within(bound))
                << "seed " << seed << " tick " << world->ticks() << ": pairs " << work.pairs
                << " of " << bound.pairs << ", contacts " << work.contacts << " of "
                << bound.contacts << ", visits " << work.visits << " of " << bound.visits
                << ", springs " << work.springs << " of " << bound.springs << ", events "
                << work.events << " of " << bound.events << ", looks " << work.looks << " of "
                << bound.looks;
            most.pairs = std::max(most.pairs, work.pairs);
            most.contacts = std::max(most.contacts, work.contacts);
            most.visits = std::max(most.visits, work.visits);
            most.springs = std::max(most.springs, work.springs);
            most.events = std::max(most.events, work.events);
            most.looks = std::max(most.looks, work.looks);
        }
    }
    // It was counted at all.
    EXPECT_GT(most.pairs, 0U);
    EXPECT_GT(most.contacts, 0U);
    EXPECT_GT(most.visits, 0U);
    EXPECT_GT(most.springs, 0U);
    EXPECT_GT(most.events, 0U);
    EXPECT_GT(most.looks, 0U);
}

} // namespace
} // namespace hapnet::test
