// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Distances and rays of random boxes against a proof: a pair of points is nearest if the boxes lie
// on two sides of a gap of that width.
#include "proto/base/random.hpp"
#include "scene/collide/distance.hpp"
#include "scene/collide/sphere_box.hpp"
#include "scene/maths/rotation.hpp"
#include "scene/maths/vector.hpp"
#include "tests/support/scene/dice.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace hapnet::scene::distance_test {
namespace {

constexpr int rounds = 20'000;

OrientedBox random_box(test::Dice& dice, double reach)
{
    OrientedBox box;
    box.centre = reach * dice.vector();
    if (!dice.one_in(4)) {
        const glm::dvec3 turn = 3.0 * dice.vector();
        box.axes = axes_of(rotation_by(turn));
    }
    box.half = {dice.power(0.1, 1.0), dice.power(0.1, 1.0), dice.power(0.1, 1.0)};
    return box;
}

/// The separation of two boxes along a direction; < 0: they overlap along it.
double gap_along(const OrientedBox& a, const OrientedBox& b, const glm::dvec3& direction)
{
    return glm::dot(direction, a.centre - b.centre) - half_projection(a, direction) -
           half_projection(b, direction);
}

bool is_in(const OrientedBox& box, const glm::dvec3& point)
{
    constexpr double rounding = 1e-12;
    const glm::dvec3 beyond = glm::abs(to_local(box, point)) - box.half;
    return std::max({beyond.x, beyond.y, beyond.z}) <= rounding;
}

glm::dvec3 random_direction(test::Dice& dice)
{
    const glm::dvec3 v = dice.vector();
    return v / length(v);
}

TEST(DistanceOfBoxes, IsThatOfTwoPointsAcrossAGapThatIsAsWide)
{
    test::Dice dice{base::Seed{1}.stream("distance")};
    int apart = 0;
    double worst = 0.0;
    for (int i = 0; i < rounds; ++i) {
        const OrientedBox a = random_box(dice, 1.5);
        const OrientedBox b = random_box(dice, 1.5);
        const Separation found = separation(a, b);
        if (found.distance <= 0.0) continue;
        ++apart;
        ASSERT_TRUE(is_in(a, found.on_first) && is_in(b, found.on_second)) << i;
        EXPECT_NEAR(length(found.on_first - found.on_second), found.distance, 1e-14);
        worst = std::max(worst, std::abs(gap_along(a, b, found.direction) - found.distance));
        ASSERT_LE(worst, 1e-11) << i;
    }
    EXPECT_GT(apart, rounds / 3);
    RecordProperty("worst", std::to_string(worst));
}

TEST(DistanceOfBoxes, ThatOverlapIsTheShortestWayOut)
{
    test::Dice dice{base::Seed{2}.stream("distance")};
    int overlapping = 0;
    for (int i = 0; i < rounds / 10; ++i) {
        const OrientedBox a = random_box(dice, 0.5);
        const OrientedBox b = random_box(dice, 0.5);
        const Separation found = separation(a, b);
        if (found.distance >= 0.0) continue;
        ++overlapping;
        EXPECT_NEAR(gap_along(a, b, found.direction), found.distance, 1e-14);
        EXPECT_TRUE(is_in(a, found.on_first)) << i;
        OrientedBox moved = a; // moved out by that vector, the boxes touch
        moved.centre -= found.distance * found.direction;
        EXPECT_NEAR(separation(moved, b).distance, 0.0, 1e-14);
        for (int other = 0; other < 200; ++other) {
            EXPECT_LE(gap_along(a, b, random_direction(dice)), found.distance + 1e-14) << i;
        }
    }
    EXPECT_GT(overlapping, rounds / 30);
}

TEST(DistanceOfAPoint, IsThatOfTheNearestPointOfTheBoxOrOfItsNearestFace)
{
    test::Dice dice{base::Seed{3}.stream("distance")};
    for (int i = 0; i < rounds; ++i) {
        const OrientedBox box = random_box(dice, 0.3);
        const glm::dvec3 point = dice.vector();
        const Separation found = separation(point, box);
        const glm::dvec3 beyond = glm::abs(to_local(box, point)) - box.half;
        const double nearest = std::max({beyond.x, beyond.y, beyond.z});
        if (nearest <= 0.0) {
            EXPECT_NEAR(found.distance, nearest, 1e-14);
        } else {
            const glm::dvec3 out = glm::max(beyond, glm::dvec3{0.0});
            EXPECT_NEAR(found.distance, length(out), 1e-14);
        }
        EXPECT_TRUE(is_in(box, found.on_second));
        EXPECT_LE(length(found.on_second + found.distance * found.direction - point), 1e-14);
        EXPECT_NEAR(length(found.direction), 1.0, 1e-14);
    }
}

TEST(ARay, EntersWhereItIsFirstInTheBoxAndMissesWhatItIsNeverIn)
{
    test::Dice dice{base::Seed{4}.stream("distance")};
    int hits = 0;
    for (int i = 0; i < rounds / 4; ++i) {
        const OrientedBox box = random_box(dice, 0.5);
        const glm::dvec3 origin = 3.0 * dice.vector();
        const glm::dvec3 aim = box.centre + dice.vector() - origin;
        const glm::dvec3 direction = aim / length(aim);
        const double length_max = dice.between(0.5, 8.0);
        const auto found = enter(box, origin, direction, length_max);
        const double until = found ? found->distance : length_max;
        constexpr int samples = 100;
        for (int k = 0; k < samples; ++k) { // outside before the ray enters
            const double at = until * k / samples;
            if (found && found->distance == 0.0) break;
            ASSERT_GE(separation(origin + at * direction, box).distance, -1e-13) << i;
        }
        if (!found) continue;
        ++hits;
        const glm::dvec3 place = origin + found->distance * direction;
        const double there = separation(place, box).distance;
        if (found->distance > 0.0) {
            EXPECT_NEAR(there, 0.0, 1e-13);
            EXPECT_LE(glm::dot(found->normal, direction), 0.0);
            EXPECT_NEAR(
                glm::dot(box.centre + half_projection(box, found->normal) * found->normal - place,
                         found->normal),
                0.0, 1e-13);
        } else {
            EXPECT_LE(there, 0.0);
        }
    }
    EXPECT_GT(hits, rounds / 40);
}

} // namespace
} // namespace hapnet::scene::distance_test
