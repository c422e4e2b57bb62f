// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Random plays of one box that does not turn, under the laws. Such plays are rare.
#include "tests/support/scene/scene_laws.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::test {
namespace {

/// Returns the play with only its first body movable, without rotation, and all else parallel.
RandomPlay with_one_box(RandomPlay play)
{
    for (scene::BodyDescription& body : play.description.bodies) {
        body.orientation = glm::dquat{1.0, 0.0, 0.0, 0.0};
        body.angular_velocity = glm::dvec3{0.0};
        body.movable = false;
    }
    play.description.bodies[0].movable = true;
    play.description.bodies[0].turning = scene::Turning::locked;
    for (scene::PlaneDescription& plane : play.description.planes) {
        int longest = 0;
        for (const int axis : {1, 2}) {
            if (std::abs(plane.normal[axis]) > std::abs(plane.normal[longest])) longest = axis;
        }
        const double sign = plane.normal[longest] < 0.0 ? -1.0 : 1.0;
        plane.normal = glm::dvec3{0.0};
        plane.normal[longest] = sign;
    }
    for (TickInputs& inputs : play.ticks) {
        std::erase_if(inputs.pushes, [](const auto& each) { return each.first != 0; });
        std::erase_if(inputs.places, [](const auto& each) { return each.first != 0; });
        for (auto& [body, state] : inputs.places) {
            state.orientation = glm::dquat{1.0, 0.0, 0.0, 0.0};
            state.angular_velocity = glm::dvec3{0.0};
        }
    }
    play.options.stepper.reset();
    return play;
}

RandomPlay one_box_play(std::uint64_t seed)
{
    constexpr std::uint32_t bodies_max = 8;
    return with_one_box(random_play(seed, {.bodies_max = bodies_max}));
}

void expect_lawful(const RandomPlay& play, std::uint64_t seed)
{
    const PlayOutcome outcome = judge(play, seed);
    EXPECT_FALSE(outcome.complaint) << "seed " << seed << ": " << *outcome.complaint;
}

TEST(OneBoxLaws, HoldInRandomPlays)
{
    for (std::uint64_t seed = 0; seed < 2000; ++seed) expect_lawful(one_box_play(seed), seed);
}

TEST(OneBoxLaws, HoldWhereTheyWereBroken)
{
    // Plays in which slanted springs held for too long: 80 kJ from rest (7008905), 9.6 N s of 0.84
    // (7014407), 1429 times the greatest force (7032638), 4.7 times (55074).
    constexpr std::array<std::uint64_t, 25> drawn{
        4480,    7433,    14984,   22970,   25226,   33593,   36736,   41982,   51807,
        55074,   55860,   7005680, 7007349, 7008905, 7011014, 7013871, 7014407, 7014900,
        7018836, 7025801, 7032638, 7039109, 7045163, 7057827, 20088227};
    for (const std::uint64_t seed : drawn) expect_lawful(random_play(seed), seed);
    // Plays changed to one box: dampers that jumped at an impact; bounces that started inside
    // obstacles; hands at full force next to elastic walls; hands of 1e7 N against each other.
    constexpr std::array<std::uint64_t, 15> made{1226,  1874,  17228,   18933,   6461,
                                                 22167, 75828, 77577,   137436,  205030,
                                                 11633, 17491, 9153009, 1113357, 1162492};
    for (const std::uint64_t seed : made) expect_lawful(one_box_play(seed), seed);
}

} // namespace
} // namespace hapnet::test
