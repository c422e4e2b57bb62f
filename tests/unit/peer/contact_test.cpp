// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/contact.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace hapnet::peer {
namespace {

constexpr double radius = 0.005;
constexpr double half = 0.020;
constexpr double rounding = 1e-15;

Box cube_at(double x) { return {{{x, 0.0, 0.0}}, glm::dvec3{half}}; }

std::optional<Overlap> overlap_at(const glm::dvec3& centre)
{
    SphereBoxContact contact;
    return contact.find(cube_at(0.0), {centre}, radius);
}

TEST(Contact, BeginsWhenASphereComesNearerThanItsRadius)
{
    EXPECT_FALSE(overlap_at({-0.0251, 0.0, 0.0}));
    EXPECT_FALSE(overlap_at({-0.025 - 1e-12, 0.0, 0.0}));
    EXPECT_TRUE(overlap_at({-0.025 + 1e-12, 0.0, 0.0}));
}

TEST(Contact, PushesStraightOutOfEachFace)
{
    for (const int axis : {0, 1, 2}) {
        for (const double sign : {-1.0, 1.0}) {
            glm::dvec3 centre{0.003, -0.004, 0.001};
            centre[axis] = sign * 0.023;
            const auto overlap = overlap_at(centre);
            ASSERT_TRUE(overlap);
            EXPECT_NEAR(overlap->depth, 0.002, rounding);
            glm::dvec3 normal{0.0};
            normal[axis] = sign;
            EXPECT_EQ(overlap->normal, normal);
        }
    }
}

TEST(Contact, AtAnEdgePointsFromTheEdgeToTheSphere)
{
    const auto overlap = overlap_at({0.023, 0.022, 0.010}); // 3 mm and 2 mm past the faces
    ASSERT_TRUE(overlap);
    const double gap = std::sqrt(9e-6 + 4e-6);
    EXPECT_NEAR(overlap->depth, radius - gap, rounding);
    EXPECT_NEAR(overlap->normal.x, 0.003 / gap, 1e-12);
    EXPECT_NEAR(overlap->normal.y, 0.002 / gap, 1e-12);
    EXPECT_EQ(overlap->normal.z, 0.0);
    EXPECT_FALSE(overlap_at({0.0241, 0.0231, 0.010})); // 4.1 and 3.1 mm: more than 5 mm away
}

TEST(Contact, AtACornerPointsFromTheCornerToTheSphere)
{
    const auto overlap = overlap_at({-0.022, -0.022, 0.022});
    ASSERT_TRUE(overlap);
    const double part = std::sqrt(1.0 / 3.0);
    EXPECT_NEAR(overlap->depth, radius - 0.002 * std::sqrt(3.0), rounding);
    EXPECT_NEAR(overlap->normal.x, -part, 1e-12);
    EXPECT_NEAR(overlap->normal.y, -part, 1e-12);
    EXPECT_NEAR(overlap->normal.z, part, 1e-12);
    EXPECT_FALSE(overlap_at({-0.023, -0.023, 0.023}));
}

TEST(Contact, RemembersTheFaceThroughWhichADeepSphereWentIn)
{
    SphereBoxContact contact;
    for (double x = -0.026; x <= 0.015; x += 0.001) {
        const auto overlap = contact.find(cube_at(0.0), {{x, 0.0, 0.0}}, radius);
        if (x < -0.0251) continue;
        ASSERT_TRUE(overlap) << x;
        EXPECT_EQ(overlap->normal, (glm::dvec3{-1.0, 0.0, 0.0})) << x; // out the way it came
        EXPECT_NEAR(overlap->depth, radius + half + x, 1e-12) << x;
    }
}

TEST(Contact, IsTheSameForACubeElsewhere)
{
    SphereBoxContact contact;
    const auto overlap = contact.find(cube_at(0.5), {{0.477, 0.0, 0.0}}, radius);
    ASSERT_TRUE(overlap);
    EXPECT_NEAR(overlap->depth, 0.002, 1e-12);
    EXPECT_EQ(overlap->normal, (glm::dvec3{-1.0, 0.0, 0.0}));
}

TEST(Contact, ForgetsTheFaceOnceTheSphereIsOut)
{
    SphereBoxContact contact;
    std::ignore = contact.find(cube_at(0.0), {{-0.021, 0.0, 0.0}}, radius);
    EXPECT_FALSE(contact.find(cube_at(0.0), {{-0.030, 0.0, 0.0}}, radius));
    const auto overlap = contact.find(cube_at(0.0), {{0.0, 0.019, 0.0}}, radius);
    ASSERT_TRUE(overlap);
    EXPECT_EQ(overlap->normal, (glm::dvec3{0.0, 1.0, 0.0})); // suddenly inside: the nearest face
}

TEST(Contact, FromInsideLeavesByTheNearestFace)
{
    for (const int axis : {0, 1, 2}) {
        for (const double sign : {-1.0, 1.0}) {
            glm::dvec3 centre{0.001, 0.002, -0.001};
            centre[axis] = sign * 0.015;
            const auto overlap = overlap_at(centre);
            ASSERT_TRUE(overlap);
            EXPECT_EQ(overlap->normal[axis], sign);
            EXPECT_NEAR(overlap->depth, radius + 0.005, rounding);
        }
    }
}

TEST(ContactForce, IsASpringAndADamperThatNeitherPullsNorExceedsItsPeak)
{
    const Scene scene;
    EXPECT_DOUBLE_EQ(contact_force(scene, 0.002, 0.0), 1.0); // 500 N/m
    EXPECT_DOUBLE_EQ(contact_force(scene, 0.002, 0.1), 1.2); // 2 N s/m
    EXPECT_DOUBLE_EQ(contact_force(scene, 0.002, -0.1), 0.8);
    EXPECT_EQ(contact_force(scene, 0.002, -1.0), 0.0);
    EXPECT_EQ(contact_force(scene, 0.1, 0.0), 3.3);
}

TEST(Distance, IsFromTheSurfaceAndZeroInside)
{
    const Box cube = cube_at(0.0);
    EXPECT_NEAR(distance(cube, {{-0.025, 0.0, 0.0}}), 0.005, rounding);
    EXPECT_NEAR(distance(cube, {{0.023, 0.024, 0.0}}), 0.005, rounding);
    EXPECT_EQ(distance(cube, {{0.020, 0.0, 0.0}}), 0.0);
    EXPECT_EQ(distance(cube, {{0.0, 0.0, 0.0}}), 0.0);
}

} // namespace
} // namespace hapnet::peer
