// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/collide/time_of_impact.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::scene::time_of_impact_test {
namespace {

OrientedBox cube(const glm::dvec3& centre) { return {.centre = centre, .half = glm::dvec3{0.5}}; }

std::optional<TimeOfImpact> touch(const glm::dvec3& centre, const glm::dvec3& velocity,
                                  double time_max)
{
    return time_of_impact(cube({0.0, 0.0, 0.0}), cube(centre), velocity, time_max);
}

TEST(FirstTouch, IsWhenTheGapIsUsedUp)
{
    const auto impact = touch({3.0, 0.25, 0.0}, {-4.0, 0.0, 0.0}, 1.0);
    ASSERT_TRUE(impact);
    EXPECT_EQ(impact->time, 0.5);
    EXPECT_EQ(impact->normal, glm::dvec3(1.0, 0.0, 0.0));
}

TEST(FirstTouch, IsFoundAtAThousandMetresPerSecondThroughAThinWall)
{
    const OrientedBox wall{.half{0.0005, 1.0, 1.0}};
    const OrientedBox bullet{.centre{-0.5, 0.1, 0.1}, .half = glm::dvec3{0.02}};
    const auto impact = time_of_impact(wall, bullet, {1000.0, 0.0, 0.0}, 1e-3);
    ASSERT_TRUE(impact);
    EXPECT_NEAR(impact->time, (0.5 - 0.0205) / 1000.0, 1e-18);
    EXPECT_EQ(impact->normal, glm::dvec3(-1.0, 0.0, 0.0));
}

TEST(FirstTouch, IsNowWhenTheyTouchAndApproach)
{
    const auto impact = touch({1.0, 0.25, 0.0}, {-1.0, 0.0, 0.0}, 1.0);
    ASSERT_TRUE(impact);
    EXPECT_EQ(impact->time, 0.0);
}

TEST(FirstTouch, IsNotWhenTheyTouchAndPartOrSlide)
{
    EXPECT_FALSE(touch({1.0, 0.25, 0.0}, {1.0, 0.0, 0.0}, 1.0));
    EXPECT_FALSE(touch({1.0, 0.25, 0.0}, {0.0, 1.0, 0.0}, 1.0));
    EXPECT_FALSE(touch({1.0, 0.25, 0.0}, {0.0, 0.0, 0.0}, 1.0));
}

TEST(FirstTouch, IsNotAlongATurnedFaceWhereRoundingMakesASpeedOfNothing)
{
    for (const double angle : {0.1, 0.7, 1.3, 2.9}) {
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        OrientedBox a = cube({0.0, 0.0, 0.0});
        a.axes = {c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0};
        OrientedBox b = a;
        b.centre = a.axes * glm::dvec3{-5.0, 1.0, 0.25};
        EXPECT_FALSE(time_of_impact(a, b, 1000.0 * a.axes[0], 1.0)) << angle;
    }
}

TEST(FirstTouch, IsNotWhenTheyOverlapAlready)
{
    EXPECT_FALSE(touch({0.9, 0.25, 0.0}, {-1.0, 0.0, 0.0}, 1.0));
}

TEST(FirstTouch, IsNotAfterTheLastMoment)
{
    EXPECT_TRUE(touch({3.0, 0.0, 0.0}, {-2.0, 0.0, 0.0}, 1.0));
    EXPECT_FALSE(touch({3.0, 0.0, 0.0}, {-2.0, 0.0, 0.0}, 1.0 - 1e-12));
}

TEST(FirstTouch, IsNotWhenOnePassesTheOther)
{
    EXPECT_FALSE(touch({3.0, 1.5, 0.0}, {-1.0, 0.0, 0.0}, 10.0));
    EXPECT_FALSE(touch({3.0, 0.0, 0.0}, {-1.0, 1.0, 0.0}, 10.0)); // above before it is there
    EXPECT_FALSE(touch({2.0, 0.0, 0.0}, {-1.0, 1.0, 0.0}, 10.0)); // corners meet at a moment only
}

TEST(FirstTouch, IsOnTheAxisOfTheEdgesWhenEdgesMeet)
{
    const double h = std::sqrt(0.5);
    OrientedBox a = cube({0.0, 0.0, 0.0});
    a.axes = {1.0, 0.0, 0.0, 0.0, h, h, 0.0, -h, h}; // an edge on top, along x
    OrientedBox b = cube({0.0, 3.0, 0.0});
    b.axes = {h, h, 0.0, -h, h, 0.0, 0.0, 0.0, 1.0}; // an edge below, along z
    const auto impact = time_of_impact(a, b, {0.0, -1.0, 0.0}, 10.0);
    ASSERT_TRUE(impact);
    EXPECT_NEAR(impact->time, 3.0 - 2.0 * h, 1e-15);
    EXPECT_NEAR(impact->normal.y, 1.0, 1e-15);
}

} // namespace
} // namespace hapnet::scene::time_of_impact_test
