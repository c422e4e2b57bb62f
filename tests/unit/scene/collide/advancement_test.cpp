// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/collide/advancement.hpp"

#include "proto/base/random.hpp"
#include "proto/base/space.hpp"
#include "scene/maths/vector.hpp"
#include "tests/support/scene/dice.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::scene::advancement_test {
namespace {

SteadyBox steady_cube(const glm::dvec3& centre, const glm::dvec3& velocity, const glm::dvec3& spin)
{
    return {.centre = centre,
            .velocity = velocity,
            .spin = spin,
            .half = glm::dvec3{0.5},
            .radius = std::sqrt(0.75)};
}

TEST(AdvanceToGap, TakesOneLookWithoutRotation)
{
    std::uint32_t steps = 1;
    const Advanced there =
        advance_to_gap(steady_cube({}, {}, {}), steady_cube({3.0, 0.25, 0.0}, {-4.0, 0.0, 0.0}, {}),
                       {.gap = 0.0, .near = 1e-13, .to = 1.0}, steps);
    EXPECT_EQ(there.end, Advanced::End::reached);
    EXPECT_NEAR(there.time, 0.5, 1e-12);
    EXPECT_EQ(steps, 0U);
}

TEST(AdvanceToGap, TakesNoLookAtWhatFliesPast)
{
    std::uint32_t steps = 0;
    const Advanced past =
        advance_to_gap(steady_cube({}, {}, {}), steady_cube({9.0, 2.0, 0.0}, {-20.0, 0.0, 0.0}, {}),
                       {.to = 1.0}, steps);
    EXPECT_EQ(past.end, Advanced::End::clear);
    EXPECT_EQ(past.time, 1.0);
}

TEST(AdvanceToGap, FindsTheCornerThatComesRoundToAPlane)
{
    // The diagonal of a face is vertical after an eighth of a turn.
    const double height = 0.5 * (0.5 + std::sqrt(0.5));
    std::uint32_t steps = 100;
    const Advanced round =
        advance_to_gap(PlaneSurface{}, steady_cube({0.0, height, 0.0}, {}, {0.0, 0.0, 1.0}),
                       {.gap = 0.0, .near = 1e-9, .to = 1.0}, steps);
    EXPECT_EQ(round.end, Advanced::End::reached);
    // (cos t + sin t) / 2 = height
    EXPECT_NEAR(0.5 * (std::cos(round.time) + std::sin(round.time)), height, 1e-9);
    EXPECT_GT(steps, 80U);
}

TEST(AdvanceToGap, SaysHowFarItCameWhenItsStepsAreUsedUp)
{
    const SteadyBox wall = steady_cube({}, {}, {});
    const SteadyBox spinner = steady_cube({1.25, 0.0, 0.0}, {-0.1, 0.0, 0.0}, {0.0, 0.0, 5.0});
    std::uint32_t steps = 1;
    const Advanced some =
        advance_to_gap(wall, spinner, {.gap = 0.0, .near = 1e-12, .to = 1.0}, steps);
    ASSERT_EQ(some.end, Advanced::End::unfinished);
    EXPECT_GT(some.time, 0.0);
    EXPECT_GT(gap_between(wall.at(some.time), spinner.at(some.time)).distance, 0.0);
}

TEST(AdvanceToGap, TakesOneLookAtWhatSpinsBesideAPlane)
{
    // An upright rod spins about its own length, so its corners move in a narrow circle.
    SteadyBox rod = steady_cube({0.0, 1.1, 0.0}, {}, {1e4, 0.0, 0.0});
    rod.half = {3.0, 0.5, 0.5};
    rod.radius = std::sqrt(9.5);
    std::uint32_t steps = 1;
    const Advanced beside = advance_to_gap(PlaneSurface{}, rod, {.to = 1.0}, steps);
    EXPECT_EQ(beside.end, Advanced::End::clear);
    // Also two rods, side by side.
    SteadyBox other = rod;
    other.centre.y += 1.5;
    other.spin = -rod.spin;
    steps = 1;
    EXPECT_EQ(advance_to_gap(rod, other, {.to = 1.0}, steps).end, Advanced::End::clear);
}

/// Boxes of any shape that fly at each other and rotate, each by a given angle in the time.
struct Meeting {
    SteadyBox a;
    SteadyBox b;
};

Meeting random_meeting(std::uint64_t seed, double turn)
{
    test::Dice dice{base::Seed{seed}.stream("meeting")};
    const auto box = [&](const glm::dvec3& centre, const glm::dvec3& velocity) {
        const glm::dvec3 half{dice.between(0.1, 1.0), dice.between(0.1, 1.0),
                              dice.between(0.1, 1.0)};
        const glm::dquat turned{dice.sign(), dice.sign(), dice.sign(), dice.sign()};
        const glm::dvec3 spin = dice.one_in(4) ? glm::dvec3{0.0} : turn * dice.vector();
        return SteadyBox{centre, base::normalized(turned), velocity, spin, half, length(half)};
    };
    return {box(0.5 * dice.vector(), dice.vector()),
            box({2.0, dice.sign(), dice.sign()}, {-4.0 * dice.share(), dice.sign(), dice.sign()})};
}

class AdvanceToGapOf : public testing::TestWithParam<double> {};

/// Compared with the gap at many moments: the result is never later than a moment at which the gap
/// is smaller than requested, and a reported gap is reached.
TEST_P(AdvanceToGapOf, TwoThatTurnNeverGoesPastATouch)
{
    constexpr double near = 1e-4;
    int reached = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        const Meeting meeting = random_meeting(seed, GetParam());
        const double gap = seed % 3 == 0 ? 0.0 : seed % 3 == 1 ? -0.03 : 0.02;
        const auto distance = [&](double time) {
            return gap_between(meeting.a.at(time), meeting.b.at(time)).distance;
        };
        if (distance(0.0) <= gap) continue;
        std::uint32_t steps = 100'000;
        const Advanced advanced =
            advance_to_gap(meeting.a, meeting.b, {gap, near, 0.0, 1.0}, steps);
        ASSERT_NE(advanced.end, Advanced::End::unfinished) << seed;
        constexpr int moments = 500;
        for (int i = 0; i < moments; ++i) {
            const double time = advanced.time * i / moments;
            ASSERT_GT(distance(time), gap) << seed << " at " << time << " of " << advanced.time;
        }
        if (advanced.end != Advanced::End::reached) continue;
        ++reached;
        EXPECT_LE(distance(advanced.time), gap + near * (1.0 + 1e-6)) << seed;
        EXPECT_GE(distance(advanced.time), gap - 1e-9) << seed;
    }
    EXPECT_GT(reached, 50);
}

INSTANTIATE_TEST_SUITE_P(Turns, AdvanceToGapOf, testing::Values(0.0, 0.1, 1.0, 10.0, 60.0));

} // namespace
} // namespace hapnet::scene::advancement_test
