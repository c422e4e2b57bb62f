// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Random scenes of everyday kinds, over two thousand ticks each, checked by independent formulas:
// `scripts/soak.sh scene` plays thousands.
#include "tests/support/scene/everyday.hpp"

#include <gtest/gtest.h>

namespace hapnet::test {
namespace {

using namespace std::chrono_literals;

class EverydayPlays : public testing::TestWithParam<Everyday> {};

TEST_P(EverydayPlays, GainNoEnergyAndStayInTheirRoom)
{
    for (const base::Duration tick :
         {base::Duration{500us}, base::Duration{1ms}, base::Duration{2ms}}) {
        for (std::uint64_t seed = 0; seed < 10; ++seed) {
            const EverydayOutcome outcome = play_everyday(everyday_play(GetParam(), seed, tick));
            EXPECT_LE(outcome.gain, 1e-4) << seed << ' ' << tick.count();
            EXPECT_FALSE(outcome.has_escaped) << seed << ' ' << tick.count();
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, EverydayPlays,
                         testing::Values(Everyday::mild, Everyday::tray, Everyday::rattle,
                                         Everyday::pens, Everyday::cradle),
                         [](const auto& each) { return std::string{name_of(each.param)}; });

TEST(EverydayCradle, KeepsItsEnergy)
{
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        const EverydayOutcome outcome = play_everyday(everyday_play(Everyday::cradle, seed, 1ms));
        EXPECT_NEAR(outcome.kept, 1.0, 1e-9) << seed;
    }
}

TEST(EverydayPens, ComeToRest)
{
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const EverydayPlay play = everyday_play(Everyday::pens, seed, 1ms);
        if (play.description.bodies[0].movable) continue; // rolls
        EXPECT_LE(play_everyday(play).restless, 1e-6) << seed;
    }
}

/// The judge's own tools.
TEST(EverydayJudge, TellsBoxesThatOverlapFromThoseThatTouch)
{
    scene::BodyDescription one, other;
    one.half = other.half = glm::dvec3{0.01};
    other.position.value = {0.02, 0.0, 0.0};
    EXPECT_FALSE(boxes_overlap(one, other));
    other.position.value.x = 0.0199;
    EXPECT_TRUE(boxes_overlap(one, other));
}

} // namespace
} // namespace hapnet::test
