// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/collide/sphere_box.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace hapnet::scene {
namespace {

constexpr double radius = 0.25;
const OrientedBox box{.centre{10.0, 20.0, 30.0}, .half{1.0, 2.0, 3.0}};
const OrientedBox plate{.half{0.0625, 2.0, 2.0}};

glm::dvec3 at(double x, double y, double z) { return box.centre + glm::dvec3{x, y, z}; }

std::optional<SphereOverlap> find(const glm::dvec3& centre)
{
    return SphereBoxMemory{}.find(box, centre, radius);
}

/// A sphere that moves relative to a box.
struct Journey {
    OrientedBox around;
    glm::dvec3 before{0.0};
    SphereBoxMemory memory{};

    std::optional<SphereOverlap> to(const glm::dvec3& place)
    {
        const glm::dvec3 from = std::exchange(before, place);
        return memory.find(around, around.centre + around.axes * place, radius, from);
    }
};

TEST(SphereBox, OverlapsAFaceByTheRadiusLessTheGap)
{
    const auto overlap = find(at(1.125, 0.5, -2.0));
    ASSERT_TRUE(overlap);
    EXPECT_EQ(overlap->depth, 0.125);
    EXPECT_EQ(overlap->normal, glm::dvec3(1.0, 0.0, 0.0));
    EXPECT_EQ(overlap->point, at(1.0, 0.5, -2.0));
    EXPECT_FALSE(find(at(1.25, 0.5, -2.0)));
}

TEST(SphereBox, OverlapsAnEdgeAndACornerTowardsTheirNearestPoint)
{
    const auto edge = find(at(1.09375, -2.125, 1.0)); // 3 : 4
    ASSERT_TRUE(edge);
    EXPECT_EQ(edge->depth, 0.25 - 0.15625);
    EXPECT_NEAR(edge->normal.x, 0.6, 1e-15);
    EXPECT_NEAR(edge->normal.y, -0.8, 1e-15);
    EXPECT_EQ(edge->point, at(1.0, -2.0, 1.0));
    const auto corner = find(at(1.0 + 0.0625, 2.0 + 0.125, -3.0 - 0.125)); // 1 : 2 : 2
    ASSERT_TRUE(corner);
    EXPECT_EQ(corner->depth, 0.25 - 0.1875);
    EXPECT_EQ(corner->point, at(1.0, 2.0, -3.0));
}

TEST(SphereBox, FollowsTheBoxWhenItTurns)
{
    OrientedBox rotated = box;
    rotated.axes = {0.6, 0.8, 0.0, -0.8, 0.6, 0.0, 0.0, 0.0, 1.0};
    const auto overlap =
        SphereBoxMemory{}.find(rotated, rotated.centre + 1.125 * rotated.axes[0], radius);
    ASSERT_TRUE(overlap);
    EXPECT_NEAR(overlap->depth, 0.125, 1e-15);
    EXPECT_NEAR(glm::distance(overlap->normal, rotated.axes[0]), 0.0, 1e-15);
    EXPECT_NEAR(distance(rotated, rotated.centre + 1.5 * rotated.axes[0]), 0.5, 1e-15);
}

TEST(SphereBox, StaysWithTheFaceWhereItWentIn)
{
    Journey journey{box, {1.3, 0.0, 0.0}};
    for (double x = 1.2; x > -0.9; x -= 0.05) {
        const auto overlap = journey.to({x, 0.0, 0.0});
        ASSERT_TRUE(overlap) << x;
        EXPECT_EQ(overlap->normal, glm::dvec3(1.0, 0.0, 0.0)) << x;
        EXPECT_NEAR(overlap->depth, radius + 1.0 - x, 1e-14) << x;
    }
}

TEST(SphereBox, SuddenlyInsideIsPushedToTheNearestFace)
{
    const auto overlap = find(at(0.0, 0.0, -2.5));
    ASSERT_TRUE(overlap);
    EXPECT_EQ(overlap->normal, glm::dvec3(0.0, 0.0, -1.0));
    EXPECT_EQ(overlap->depth, 0.75);
    EXPECT_EQ(overlap->point, at(0.0, 0.0, -3.0));
}

TEST(SphereBox, ThroughAPlateWithinOneTickIsFoundInFrontOfIt)
{
    Journey journey{plate, {1.0, 0.0, 0.0}};
    for (const double x : {-1.0, -2.0, -0.07, -0.01}) {
        const auto overlap = journey.to({x, 0.5, 0.0});
        ASSERT_TRUE(overlap) << x;
        EXPECT_EQ(overlap->normal, glm::dvec3(1.0, 0.0, 0.0)) << x;
        EXPECT_EQ(overlap->depth, radius + 0.0625 - x) << x;
        EXPECT_EQ(overlap->point, glm::dvec3(0.0625, 0.5, 0.0)) << x;
    }
    EXPECT_FALSE(journey.to({0.5, 0.5, 0.0}));
    EXPECT_FALSE(journey.memory.entered());
}

TEST(SphereBox, PushedSlowlyThroughAPlateIsStillFoundInFrontOfIt)
{
    Journey journey{plate, {0.5, 0.0, 0.0}};
    for (double x = 0.3; x > -2.0; x -= 0.01) {
        const auto overlap = journey.to({x, 0.0, 0.0});
        ASSERT_TRUE(overlap) << x;
        EXPECT_EQ(overlap->normal, glm::dvec3(1.0, 0.0, 0.0)) << x;
    }
}

TEST(SphereBox, BehindAPlateIsLetGoWhenItLeavesToTheSide)
{
    Journey journey{plate, {1.0, 0.0, 0.0}};
    EXPECT_TRUE(journey.to({-1.0, 1.5, 0.0}));
    EXPECT_FALSE(journey.to({-1.0, 2.5, 0.0}));
    EXPECT_FALSE(journey.to({-1.0, 1.5, 0.0})); // it came back on the other side
    const auto overlap = journey.to({-0.1, 1.5, 0.0});
    ASSERT_TRUE(overlap);
    EXPECT_EQ(overlap->normal, glm::dvec3(-1.0, 0.0, 0.0));
}

TEST(SphereBox, AroundTheEdgeOfAPlateIsNotThroughIt)
{
    Journey journey{plate, {1.0, 1.8, 0.0}};
    EXPECT_FALSE(journey.to({0.5, 2.5, 0.0}));
    EXPECT_FALSE(journey.to({-0.5, 2.5, 0.0}));
    EXPECT_FALSE(journey.to({-1.0, 1.8, 0.0}));
}

TEST(SphereBox, PutElsewhereRemembersNothing)
{
    const double reach = sphere_reach_of_half * 2.0;
    Journey journey{plate, {0.5 * reach + 0.1, 0.0, 0.0}};
    EXPECT_FALSE(journey.to({-0.5 * reach, 0.0, 0.0}));
    Journey inside{plate, {0.01 + reach, 0.0, 0.0}};
    const auto overlap = inside.to({-0.01, 0.0, 0.0});
    ASSERT_TRUE(overlap);
    EXPECT_EQ(overlap->normal, glm::dvec3(-1.0, 0.0, 0.0)); // the nearest
}

TEST(SphereBox, EntersAtTheFaceThatItsWayMeetsFirst)
{
    Journey journey{box, {1.5, 2.25, 0.0}};
    const auto overlap = journey.to({0.9, 1.0, 0.0}); // enters at x = 1 later than at y = 2
    ASSERT_TRUE(overlap);
    EXPECT_EQ(overlap->normal, glm::dvec3(1.0, 0.0, 0.0));
    Journey other{box, {1.25, 2.5, 0.0}};
    const auto top = other.to({0.5, 1.9, 0.0});
    ASSERT_TRUE(top);
    EXPECT_EQ(top->normal, glm::dvec3(0.0, 1.0, 0.0));
}

TEST(SphereBox, HasADistanceOfZeroInside)
{
    EXPECT_EQ(distance(box, at(0.5, -1.0, 2.0)), 0.0);
    EXPECT_EQ(distance(box, at(1.0 + 3.0, 2.0 + 4.0, 0.0)), 5.0);
}

} // namespace
} // namespace hapnet::scene
