// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/collide/box_box.hpp"

#include "proto/base/random.hpp"
#include "scene/collide/manifold.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::scene {
namespace {

constexpr double margin = 1e-3;

glm::dmat3 rotated(int axis, double cosine, double sine)
{
    const int next = (axis + 1) % 3;
    const int last = (axis + 2) % 3;
    glm::dmat3 result{1.0};
    result[next][next] = cosine;
    result[next][last] = sine;
    result[last][next] = -sine;
    result[last][last] = cosine;
    return result;
}

OrientedBox cube(const glm::dvec3& centre, const glm::dmat3& axes = glm::dmat3{1.0})
{
    return {.centre = centre, .axes = axes, .half = glm::dvec3{0.5}};
}

Manifold touch(const OrientedBox& a, const OrientedBox& b)
{
    BoxBoxMemory memory;
    return collide(a, b, margin, memory);
}

std::vector<std::uint32_t> features(const Manifold& manifold)
{
    std::vector<std::uint32_t> result;
    for (const ContactPoint& point : manifold.touching()) result.push_back(point.feature);
    std::sort(result.begin(), result.end());
    return result;
}

bool has_point(const Manifold& manifold, double x, double z)
{
    return std::any_of(
        manifold.touching().begin(), manifold.touching().end(), [&](const ContactPoint& p) {
            return std::abs(p.position.x - x) < 1e-12 && std::abs(p.position.z - z) < 1e-12;
        });
}

TEST(BoxBox, StackedExactlyTouchWithAllFourCorners)
{
    const Manifold manifold = touch(cube({0.0, 0.0, 0.0}), cube({0.0, 0.9375, 0.0}));
    ASSERT_EQ(manifold.count, 4U);
    EXPECT_EQ(manifold.normal, glm::dvec3(0.0, 1.0, 0.0));
    for (const ContactPoint& point : manifold.touching()) {
        EXPECT_EQ(point.separation, -0.0625);
        EXPECT_EQ(point.position.y, 0.46875);
        EXPECT_EQ(std::abs(point.position.x), 0.5);
        EXPECT_EQ(std::abs(point.position.z), 0.5);
    }
    for (const double x : {-0.5, 0.5})
        for (const double z : {-0.5, 0.5}) EXPECT_TRUE(has_point(manifold, x, z));
}

TEST(BoxBox, ShiftedTouchWhereTheirFacesLieOnEachOther)
{
    const Manifold manifold = touch(cube({0.0, 0.0, 0.0}), cube({0.25, 1.0, -0.125}));
    ASSERT_EQ(manifold.count, 4U);
    for (const double x : {-0.25, 0.5})
        for (const double z : {-0.5, 0.375}) EXPECT_TRUE(has_point(manifold, x, z));
}

TEST(BoxBox, OnASlabTouchWithTheSmallBoxesCornersWhicheverIsFirst)
{
    const OrientedBox slab{.centre{0.0, -1.0, 0.0}, .half{5.0, 1.0, 5.0}};
    const OrientedBox small = cube({1.0, 0.5, 2.0}, rotated(1, 0.8, 0.6));
    const Manifold below = touch(slab, small);
    const Manifold above = touch(small, slab);
    EXPECT_EQ(below.normal, glm::dvec3(0.0, 1.0, 0.0));
    EXPECT_EQ(above.normal, glm::dvec3(0.0, -1.0, 0.0));
    ASSERT_EQ(below.count, 4U);
    ASSERT_EQ(above.count, 4U);
    for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t feature = below.points[k].feature;
        EXPECT_EQ(feature & 63U, face_bit(1, true));
        EXPECT_EQ(above.points[k].feature, swapped_feature_pair(feature));
        EXPECT_EQ(above.points[k].position, below.points[k].position);
    }
}

// Every second corner of the octagon, so that the base is equally wide in all directions.
TEST(BoxBox, TwistedOnEachOtherTouchWithFourOfEightCornersAroundTheMiddle)
{
    const double half_angle = std::sqrt(0.5);
    const Manifold manifold =
        touch(cube({0.0, 0.0, 0.0}), cube({0.0, 1.0, 0.0}, rotated(1, half_angle, half_angle)));
    ASSERT_EQ(manifold.count, 4U);
    glm::dvec3 sum{0.0};
    for (const ContactPoint& point : manifold.touching()) {
        sum += point.position;
        const double radius =
            std::sqrt(point.position.x * point.position.x + point.position.z * point.position.z);
        EXPECT_NEAR(radius, 0.5 / std::cos(std::acos(-1.0) / 8.0), 1e-12);
    }
    EXPECT_NEAR(sum.x, 0.0, 1e-12);
    EXPECT_NEAR(sum.z, 0.0, 1e-12);
}

TEST(BoxBox, WithCrossedEdgesTouchInOnePointBetweenThem)
{
    const double half_angle = std::sqrt(0.5);
    const OrientedBox a = cube({0.0, 0.0, 0.0}, rotated(0, half_angle, half_angle)); // edge along x
    const OrientedBox b =
        cube({0.125, 2.0 * half_angle - 0.01, 0.25}, rotated(2, half_angle, half_angle)); // along z
    const Manifold manifold = touch(a, b);
    ASSERT_EQ(manifold.count, 1U);
    EXPECT_NEAR(manifold.normal.y, 1.0, 1e-12);
    EXPECT_NEAR(manifold.points[0].separation, -0.01, 1e-12);
    EXPECT_NEAR(manifold.points[0].position.x, 0.125, 1e-12);
    EXPECT_NEAR(manifold.points[0].position.y, half_angle - 0.005, 1e-12);
    EXPECT_NEAR(manifold.points[0].position.z, 0.0, 1e-12);
}

TEST(BoxBox, CountPointsUpToTheMarginAndNoneBeyond)
{
    const Manifold within = touch(cube({0.0, 0.0, 0.0}), cube({0.0, 1.0 + 0.9 * margin, 0.0}));
    ASSERT_EQ(within.count, 4U);
    EXPECT_NEAR(within.points[0].separation, 0.9 * margin, 1e-15);
    EXPECT_EQ(touch(cube({0.0, 0.0, 0.0}), cube({0.0, 1.0 + 1.1 * margin, 0.0})).count, 0U);
    EXPECT_EQ(touch(cube({0.0, 0.0, 0.0}), cube({1.0 + 1.1 * margin, 0.0, 0.0})).count, 0U);
}

TEST(BoxBox, WithOneCentreStillHaveADirectionAndADepth)
{
    const Manifold manifold = touch(cube({2.0, 2.0, 2.0}), cube({2.0, 2.0, 2.0}));
    ASSERT_EQ(manifold.count, 4U);
    EXPECT_EQ(manifold.normal, glm::dvec3(1.0, 0.0, 0.0));
    EXPECT_EQ(manifold.points[0].separation, -1.0);
}

TEST(BoxBox, LyingFlushKeepTheirFeaturesUnderSmallTremors)
{
    BoxBoxMemory memory;
    const OrientedBox below = cube({0.0, 0.0, 0.0});
    const std::vector<std::uint32_t> first =
        features(collide(below, cube({0.0, 1.0, 0.0}), margin, memory));
    const auto draw = base::Seed{1}.stream("tremor");
    for (std::uint64_t k = 0; k < 200; ++k) {
        const auto tremor = [&](std::uint32_t n) { return 2e-4 * (draw.uniform(k, n) - 0.5); };
        glm::dmat3 axes = rotated(1, 1.0, tremor(0)) * rotated(0, 1.0, tremor(1)); // to 1e-8
        const OrientedBox above = cube({tremor(2), 1.0 + tremor(3), tremor(4)}, axes);
        EXPECT_EQ(features(collide(below, above, margin, memory)), first) << k;
    }
}

TEST(BoxBox, SlidingKeepTheirFeaturesUntilACornerLeaves)
{
    BoxBoxMemory memory;
    const OrientedBox slab{.centre{0.0, -1.0, 0.0}, .half{5.0, 1.0, 5.0}};
    std::optional<std::vector<std::uint32_t>> first;
    for (int k = 0; k < 100; ++k) {
        const Manifold manifold = collide(slab, cube({0.04 * k, 0.5, 0.0}), margin, memory);
        if (!first) first = features(manifold);
        EXPECT_EQ(features(manifold), *first) << k;
    }
    EXPECT_NE(features(collide(slab, cube({4.75, 0.5, 0.0}), margin, memory)), *first);
}

// On the diagonal two faces are equally good. Noise must not choose between them at every tick.
TEST(BoxBox, KeepTheirAxisWhileAnotherIsNoClearlyBetter)
{
    BoxBoxMemory memory;
    const OrientedBox a = cube({0.0, 0.0, 0.0});
    std::ignore = collide(a, cube({0.9, 0.91, 0.0}), margin, memory);
    const std::int8_t first = memory.axis;
    EXPECT_EQ(first, 1);
    for (const double x : {0.909, 0.911, 0.913})
        std::ignore = collide(a, cube({x, 0.91, 0.0}), margin, memory);
    EXPECT_EQ(memory.axis, first);
    std::ignore = collide(a, cube({0.92, 0.91, 0.0}), margin, memory);
    EXPECT_EQ(memory.axis, 0);
}

TEST(BoxBox, RememberWhatKeepsThemApart)
{
    BoxBoxMemory memory;
    EXPECT_EQ(collide(cube({0.0, 0.0, 0.0}), cube({0.0, 0.0, 3.0}), margin, memory).count, 0U);
    EXPECT_EQ(memory.axis, 2);
    EXPECT_EQ(collide(cube({0.0, 0.0, 0.0}), cube({0.0, 0.9, 3.0}), margin, memory).count, 0U);
    EXPECT_EQ(memory.axis, 2);
}

} // namespace
} // namespace hapnet::scene
