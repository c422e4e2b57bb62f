// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Spheres and capsules, against each other and against boxes. A distance is right if the
// projections onto its direction are that far apart, and onto no other direction farther.
#include "proto/base/random.hpp"
#include "scene/collide/box_box.hpp"
#include "scene/collide/distance.hpp"
#include "scene/collide/time_of_impact.hpp"
#include "scene/maths/rotation.hpp"
#include "scene/maths/vector.hpp"
#include "tests/support/scene/dice.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::scene::round_test {
namespace {

constexpr int rounds = 20'000;

glm::dmat3 random_axes(test::Dice& dice)
{
    const glm::dvec3 turn = 3.0 * dice.vector();
    return axes_of(rotation_by(turn));
}

OrientedBox random_round(test::Dice& dice, double reach)
{
    OrientedBox shape;
    shape.centre = reach * dice.vector();
    if (!dice.one_in(4)) shape.axes = random_axes(dice);
    shape.rounding = dice.power(0.05, 0.5);
    shape.half = glm::dvec3{shape.rounding};
    if (!dice.one_in(3)) shape.half[static_cast<int>(dice.below(3))] += dice.power(0.01, 1.0);
    return shape;
}

OrientedBox random_other(test::Dice& dice, double reach)
{
    if (dice.one_in(2)) return random_round(dice, reach);
    OrientedBox box;
    box.centre = reach * dice.vector();
    if (!dice.one_in(4)) box.axes = random_axes(dice);
    box.half = {dice.power(0.1, 1.0), dice.power(0.1, 1.0), dice.power(0.1, 1.0)};
    return box;
}

struct Two {
    OrientedBox a, b;
};

Two random_two(test::Dice& dice)
{
    const double reach = dice.power(0.01, 2.0);
    Two two{random_round(dice, reach), random_other(dice, reach)};
    if (dice.one_in(4)) two.b.axes = two.a.axes; // parallel
    if (dice.one_in(2)) std::swap(two.a, two.b);
    return two;
}

double gap_along(const Two& two, const glm::dvec3& direction)
{
    return glm::dot(direction, two.a.centre - two.b.centre) - half_extent(two.a, direction) -
           half_extent(two.b, direction);
}

glm::dvec3 random_direction(test::Dice& dice)
{
    const glm::dvec3 v = dice.vector();
    return v / length(v);
}

TEST(RoundDistance, IsTheWidestGapOfAllDirectionsAndThatOfTwoPointsOfTheSurfaces)
{
    test::Dice dice{base::Seed{1}.stream("round")};
    int apart = 0;
    for (int i = 0; i < rounds; ++i) {
        const Two two = random_two(dice);
        const Separation found = separation(two.a, two.b);
        ASSERT_NEAR(gap_along(two, found.direction), found.distance, 1e-12) << i;
        ASSERT_NEAR(length(found.direction), 1.0, 1e-12) << i;
        const glm::dvec3 across = found.on_first - found.on_second;
        ASSERT_LT(length(across - found.distance * found.direction), 1e-11) << i;
        for (int k = 0; k < 30; ++k) {
            const glm::dvec3 near = found.direction + 0.1 * dice.vector();
            ASSERT_LE(gap_along(two, near / length(near)), found.distance + 1e-12) << i;
            ASSERT_LE(gap_along(two, random_direction(dice)), found.distance + 1e-12) << i;
        }
        const Separation back = separation(two.b, two.a);
        ASSERT_NEAR(back.distance, found.distance, 1e-12) << i;
        if (found.distance > 0.0) ++apart;
    }
    EXPECT_GT(apart, rounds / 4);
    EXPECT_LT(apart, rounds);
}

TEST(RoundManifold, HasTheNearestPlaceAndNoneThatIsFartherThanTheMargin)
{
    test::Dice dice{base::Seed{2}.stream("round")};
    int pairs = 0;
    for (int i = 0; i < rounds; ++i) {
        const Two two = random_two(dice);
        const Separation found = separation(two.a, two.b);
        const double margin = 0.1 * dice.share();
        BoxBoxMemory memory;
        const Manifold manifold = collide(two.a, two.b, margin, memory);
        ASSERT_EQ(manifold.count == 0, found.distance > margin) << i;
        if (manifold.count == 0) continue;
        // A body that is parallel to a face within a degree is pushed along the face's normal.
        constexpr double along_sine = 1.0 / 64.0;
        const double most = manifold.count == 2 ? along_sine : 1e-12;
        ASSERT_LT(length(manifold.normal + found.direction), most) << i;
        double least = margin;
        for (const ContactPoint& point : manifold.touching()) {
            least = std::min(least, point.separation);
            ASSERT_GE(point.separation, found.distance - 1e-12) << i;
            if (point.separation > found.distance + 1e-12 || found.distance < 0.0) continue;
            // The point is midway between the two surfaces.
            const double to_a = separation(point.position, two.a).distance;
            const double to_b = separation(point.position, two.b).distance;
            ASSERT_NEAR(to_a, 0.5 * point.separation, 1e-9) << i;
            ASSERT_NEAR(to_b, 0.5 * point.separation, 1e-9) << i;
        }
        // These are the ends of a nearly parallel body. Between them it may be a little nearer.
        ASSERT_NEAR(least, found.distance, manifold.count == 2 ? 1e-3 : 1e-12) << i;
        if (manifold.count == 2) ++pairs;
        const Manifold back = collide(two.b, two.a, margin, memory);
        ASSERT_EQ(back.count, manifold.count) << i;
        ASSERT_LT(length(back.normal + manifold.normal), 1e-12) << i;
    }
    EXPECT_GT(pairs, rounds / 50);
}

TEST(RoundTimeOfImpact, IsWhenTheyAreFirstAtNoDistance)
{
    test::Dice dice{base::Seed{3}.stream("round")};
    int hits = 0;
    for (int i = 0; i < rounds; ++i) {
        Two two = random_two(dice);
        two.b.centre += 3.0 * random_direction(dice);
        if (separation(two.a, two.b).distance <= 0.0) continue;
        const glm::dvec3 velocity = two.a.centre - two.b.centre + dice.vector();
        const auto at = [&](double time) {
            Two then = two;
            then.b.centre += time * velocity;
            return separation(then.a, then.b).distance;
        };
        const auto impact = time_of_impact(two.a, two.b, velocity, 2.0);
        const double until = impact ? impact->time : 2.0;
        for (int k = 0; k < 20; ++k) ASSERT_GT(at(dice.share() * until), -1e-9) << i;
        if (!impact) continue;
        ++hits;
        ASSERT_LT(std::abs(at(impact->time)), 1e-8) << i;
        ASSERT_LT(glm::dot(impact->normal, velocity), 0.0) << i;
    }
    EXPECT_GT(hits, rounds / 4);
}

TEST(RoundRay, EntersWhereItIsFirstAtNoDistance)
{
    test::Dice dice{base::Seed{4}.stream("round")};
    int hits = 0;
    for (int i = 0; i < rounds; ++i) {
        const OrientedBox shape = random_round(dice, 0.5);
        const glm::dvec3 origin = 2.0 * dice.vector();
        const glm::dvec3 aim = shape.centre + dice.vector() - origin;
        const glm::dvec3 direction = aim / length(aim);
        const auto entry = enter(shape, origin, direction, 10.0);
        if (separation(origin, shape).distance < 0.0) {
            ASSERT_TRUE(entry && entry->distance == 0.0) << i;
            continue;
        }
        const double until = entry ? entry->distance : 10.0;
        for (int k = 0; k < 20; ++k) {
            const glm::dvec3 place = origin + dice.share() * until * direction;
            ASSERT_GE(separation(place, shape).distance, -1e-9) << i;
        }
        if (!entry) continue;
        ++hits;
        const Separation there = separation(origin + entry->distance * direction, shape);
        ASSERT_NEAR(there.distance, 0.0, 1e-9) << i;
        ASSERT_LT(length(there.direction - entry->normal), 1e-6) << i;
    }
    EXPECT_GT(hits, rounds / 20);
}

} // namespace
} // namespace hapnet::scene::round_test
