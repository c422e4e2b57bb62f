// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/collide/box_plane.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::scene::box_plane_test {
namespace {

using Features = std::array<std::uint32_t, manifold_points_max>;

Features features(const std::array<PlaneCorner, manifold_points_max>& corners)
{
    Features result{};
    for (std::size_t i = 0; i < corners.size(); ++i) result[i] = corners[i].feature;
    return result;
}

const glm::dvec3 up{0.0, 1.0, 0.0};
const glm::dmat3 upright{1.0};

TEST(BoxPlane, TheDeepestCornersAreTheFourOfTheFaceThatLiesOnIt)
{
    const auto corners = deepest_corners(up, upright, {0.5, 0.25, 2.0});
    EXPECT_EQ(features(corners), (Features{0, 1, 4, 5}));
    EXPECT_EQ(corners[0].place, glm::dvec3(-0.5, -0.25, -2.0));
    EXPECT_EQ(corners[3].place, glm::dvec3(0.5, -0.25, 2.0));
    for (const PlaneCorner& corner : corners) EXPECT_EQ(corner.rise, -0.25);
}

TEST(BoxPlane, TwoAreDeepestWhenTheBoxStandsOnAnEdge)
{
    const double diagonal = std::sqrt(0.5);
    const glm::dmat3 axes{1.0, 0.0, 0.0, 0.0, diagonal, diagonal, 0.0, -diagonal, diagonal};
    const auto corners = deepest_corners(up, axes, glm::dvec3{0.5});
    int deepest = 0;
    for (const PlaneCorner& corner : corners) {
        if (corner.rise > -0.5) continue;
        ++deepest;
        EXPECT_NEAR(corner.rise, -diagonal, 1e-15);
        EXPECT_NEAR(corner.place.z, 0.0, 1e-15);
        EXPECT_EQ(std::abs(corner.place.x), 0.5);
    }
    EXPECT_EQ(deepest, 2);
}

TEST(BoxPlane, ABoxOnACornerHasThatAndItsNeighbours)
{
    const glm::dvec3 slope{std::sqrt(1.0 / 3.0)};
    EXPECT_EQ(features(deepest_corners(slope, upright, glm::dvec3{0.5})), (Features{0, 1, 2, 4}));
    EXPECT_EQ(features(deepest_corners({0.6, 0.48, 0.64}, upright, glm::dvec3{0.5})),
              (Features{0, 1, 2, 4}));
}

TEST(BoxPlane, EachOfTheSixFacesHasItsCorners)
{
    const std::array<Features, 6> corners{
        {{0, 2, 4, 6}, {1, 3, 5, 7}, {0, 1, 4, 5}, {2, 3, 6, 7}, {0, 1, 2, 3}, {4, 5, 6, 7}}};
    for (std::size_t face = 0; face < 6; ++face) {
        glm::dvec3 normal{0.0};
        normal[static_cast<int>(face / 2)] = face % 2 == 0 ? 1.0 : -1.0;
        EXPECT_EQ(features(deepest_corners(normal, upright, glm::dvec3{0.5})), corners.at(face))
            << face;
    }
}

} // namespace
} // namespace hapnet::scene::box_plane_test
