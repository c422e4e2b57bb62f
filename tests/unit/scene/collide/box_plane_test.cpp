// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/collide/box_plane.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::scene::box_plane_test {
namespace {

const PlaneSurface ground{.normal{0.0, 1.0, 0.0}, .offset = 1.0};
const double diagonal = std::sqrt(0.5);

OrientedBox box_at(double height)
{
    return {.centre{3.0, 1.0 + height, 5.0}, .half{0.5, 0.25, 2.0}};
}

/// Stands on an edge that is parallel to x.
OrientedBox on_edge(double height)
{
    return {.centre{0.0, 1.0 + height, 0.0},
            .axes{1.0, 0.0, 0.0, 0.0, diagonal, diagonal, 0.0, -diagonal, diagonal},
            .half = glm::dvec3{0.5}};
}

std::vector<std::uint32_t> features(const Manifold& manifold)
{
    std::vector<std::uint32_t> result;
    for (const ContactPoint& point : manifold.touching()) result.push_back(point.feature);
    return result;
}

TEST(BoxPlane, TouchesWithTheFourCornersOfTheFaceThatLiesOnIt)
{
    const Manifold manifold = collide(ground, box_at(0.1875), 0.0);
    EXPECT_EQ(features(manifold), (std::vector<std::uint32_t>{0, 1, 4, 5}));
    EXPECT_EQ(manifold.normal, ground.normal);
    EXPECT_EQ(manifold.points[0].separation, -0.0625);
    EXPECT_EQ(manifold.points[0].position, glm::dvec3(2.5, 1.0 - 0.03125, 3.0));
    EXPECT_EQ(manifold.points[3].position, glm::dvec3(3.5, 1.0 - 0.03125, 7.0));
}

TEST(BoxPlane, CountsPointsUpToTheMarginAndNotAHairFarther)
{
    EXPECT_EQ(collide(ground, box_at(0.375), 0.125).count, 4U);
    EXPECT_EQ(collide(ground, box_at(0.375), 0.125).points[1].separation, 0.125);
    EXPECT_EQ(collide(ground, box_at(0.375 + 1e-12), 0.125).count, 0U);
}

TEST(BoxPlane, TouchesWithTwoCornersWhenTheBoxStandsOnAnEdge)
{
    const Manifold manifold = collide(ground, on_edge(0.5 / diagonal - 1e-3), 1e-3);
    ASSERT_EQ(manifold.count, 2U);
    for (const ContactPoint& point : manifold.touching()) {
        EXPECT_NEAR(point.separation, -1e-3, 1e-15);
        EXPECT_NEAR(point.position.y, 1.0 - 0.5e-3, 1e-15);
        EXPECT_NEAR(point.position.z, 0.0, 1e-15);
        EXPECT_EQ(std::abs(point.position.x), 0.5);
    }
}

TEST(BoxPlane, TouchesWithOneCornerWhenTheBoxStandsOnIt)
{
    const PlaneSurface slope{.normal = glm::dvec3{std::sqrt(1.0 / 3.0)}, .offset = 0.0};
    const OrientedBox cube{.centre = glm::dvec3{0.49}, .half = glm::dvec3{0.5}};
    const Manifold manifold = collide(slope, cube, 1e-3);
    ASSERT_EQ(features(manifold), (std::vector<std::uint32_t>{0}));
    EXPECT_NEAR(manifold.points[0].separation, -0.03 * slope.normal.x, 1e-15);
}

TEST(BoxPlane, TakesTheDeepestFourOfABoxFarBelow)
{
    EXPECT_EQ(features(collide(ground, box_at(-9.0), 0.0)),
              (std::vector<std::uint32_t>{0, 1, 4, 5}));
    // A corner first: it and its neighbours.
    const PlaneSurface slope{.normal{0.6, 0.48, 0.64}, .offset = 9.0};
    const OrientedBox cube{.half = glm::dvec3{0.5}};
    EXPECT_EQ(features(collide(slope, cube, 0.0)), (std::vector<std::uint32_t>{0, 1, 2, 4}));
}

TEST(BoxPlane, TouchesWithTheSameCornersOfEachOfTheSixFaces)
{
    const std::array<std::vector<std::uint32_t>, 6> corners{
        {{0, 2, 4, 6}, {1, 3, 5, 7}, {0, 1, 4, 5}, {2, 3, 6, 7}, {0, 1, 2, 3}, {4, 5, 6, 7}}};
    for (std::size_t face = 0; face < 6; ++face) {
        PlaneSurface plane{.normal = glm::dvec3{0.0}};
        plane.normal[static_cast<int>(face / 2)] = face % 2 == 0 ? 1.0 : -1.0;
        plane.offset = -0.5;
        const OrientedBox cube{.half = glm::dvec3{0.5}};
        EXPECT_EQ(features(collide(plane, cube, 0.0)), corners.at(face)) << face;
    }
}

} // namespace
} // namespace hapnet::scene::box_plane_test
