// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/collide/box_box.hpp"

#include "scene/collide/manifold.hpp"
#include "tests/property/scene/collide/boxes.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace hapnet::scene {
namespace {

constexpr std::uint64_t pairs = 200;
// The cost of the choice of features, in smallest half edges: see collide().
constexpr double slack = 1.0 / 128.0;
constexpr double flush = 1.0 / 256.0;
constexpr double rounding = 1e-9;
// Points within the tolerance of a border are moved onto it along both edges, in a plane that leans
// at most 55 degrees: by the square root of 6 times the tolerance.
constexpr double on_border = 2.45 * flush;

constexpr std::array<double, 5> size_ratios{1.0, 1.0, 0.1, 10.0, 1000.0};

struct Case {
    BoxPair pair;
    double unit = 0.0; // the smallest half edge
    double margin = 0.0;
    BoxBoxMemory memory; // from another tick: none, or any axis
};

Case draw(std::string_view stream, std::uint64_t seed)
{
    BoxesDrawn drawn{base::Seed{seed}.stream(stream)};
    const double gap = drawn.uniform(-0.1, 0.05);
    const BoxPair pair = near_pair(drawn, size_ratios.at(seed % size_ratios.size()), gap);
    const auto axis = static_cast<std::int8_t>(drawn.uniform(-1.0, 14.99));
    return {pair, pair.smallest_half(), 0.03 * pair.smallest_half(),
            BoxBoxMemory{.axis = drawn.one_in(2) ? std::int8_t{-1} : axis}};
}

/// The distance of a point from a box; < 0: inside.
double outside(const OrientedBox& box, const glm::dvec3& point)
{
    double most = -HUGE_VAL;
    for (const int k : {0, 1, 2}) {
        most = std::max(most, std::abs(glm::dot(box.axes[k], point - box.centre)) - box.half[k]);
    }
    return most;
}

const ContactPoint* found(const Manifold& manifold, std::uint32_t feature)
{
    for (const ContactPoint& point : manifold.touching())
        if (point.feature == feature) return &point;
    return nullptr;
}

TEST(BoxBox, TouchExactlyWhenNoneOfFifteenAxesSeparatesThem)
{
    for (std::uint64_t seed = 0; seed < pairs; ++seed) {
        Case drawn = draw("touch", seed);
        const auto& [a, b] = drawn.pair;
        const auto truth = static_cast<double>(Exhaustive::separation(a, b)) / drawn.unit;
        const Manifold manifold = collide(a, b, drawn.margin, drawn.memory);
        // A gap between 0 and the margin may be beside the faces, where no contact is reported.
        if (truth < -rounding) {
            ASSERT_GT(manifold.count, 0U) << seed << ' ' << truth;
        }
        if (truth > 0.03 + flush) {
            ASSERT_EQ(manifold.count, 0U) << seed << ' ' << truth;
        }
        for (const ContactPoint& point : manifold.touching())
            ASSERT_GE(point.separation / drawn.unit, truth - 2.0 * slack - rounding) << seed;
    }
}

TEST(BoxBox, HavePointsOnBothSurfacesAlongAUnitNormalFromTheFirst)
{
    for (std::uint64_t seed = 0; seed < pairs; ++seed) {
        Case drawn = draw("points", seed);
        const auto& [a, b] = drawn.pair;
        const Manifold manifold = collide(a, b, drawn.margin, drawn.memory);
        if (manifold.count == 0) continue;
        const glm::dvec3& normal = manifold.normal;
        ASSERT_NEAR(glm::dot(normal, normal), 1.0, 1e-9) << seed;
        ASSERT_GE(glm::dot(normal, b.centre - a.centre), 0.0) << seed;
        for (const ContactPoint& point : manifold.touching()) {
            ASSERT_LE(point.separation, drawn.margin) << seed;
            const glm::dvec3 half_gap = 0.5 * point.separation * normal;
            ASSERT_LE(outside(a, point.position - half_gap), on_border * drawn.unit) << seed;
            ASSERT_LE(outside(b, point.position + half_gap), on_border * drawn.unit) << seed;
        }
    }
}

TEST(BoxBox, HaveTheSamePointsATickLater)
{
    for (std::uint64_t seed = 0; seed < pairs; ++seed) {
        Case drawn = draw("again", seed);
        const auto& [a, b] = drawn.pair;
        const Manifold first = collide(a, b, drawn.margin, drawn.memory);
        const Manifold again = collide(a, b, drawn.margin, drawn.memory);
        ASSERT_EQ(first.count, again.count) << seed;
        for (std::uint32_t k = 0; k < first.count; ++k) {
            ASSERT_EQ(first.points[k].feature, again.points[k].feature) << seed;
            ASSERT_EQ(first.points[k].separation, again.points[k].separation) << seed;
            ASSERT_EQ(first.points[k].position, again.points[k].position) << seed;
        }
    }
}

TEST(BoxBox, HaveEachMeetingOfFeaturesOnlyOnce)
{
    for (std::uint64_t seed = 0; seed < pairs; ++seed) {
        Case drawn = draw("once", seed);
        const auto& [a, b] = drawn.pair;
        const Manifold manifold = collide(a, b, drawn.margin, drawn.memory);
        for (const ContactPoint& point : manifold.touching())
            ASSERT_EQ(found(manifold, point.feature), &point) << seed;
    }
}

TEST(BoxBox, TouchLikewiseWhenTheyAreExchanged)
{
    std::uint64_t compared = 0;
    for (std::uint64_t seed = 0; seed < pairs; ++seed) {
        const Case drawn = draw("exchanged", seed);
        const auto& [a, b] = drawn.pair;
        BoxBoxMemory of_a;
        BoxBoxMemory of_b;
        const Manifold here = collide(a, b, drawn.margin, of_a);
        const Manifold there = collide(b, a, drawn.margin, of_b);
        if (here.count == 0 || glm::dot(here.normal, there.normal) > -1.0 + 1e-12) continue;
        ++compared;
        const double tolerance = 2.0 * flush * drawn.unit;
        for (const ContactPoint& point : here.touching()) {
            const ContactPoint* same = found(there, swapped_feature_pair(point.feature));
            if (same == nullptr) continue; // where several points are equally good
            ASSERT_NEAR(point.separation, same->separation, tolerance) << seed;
            ASSERT_LE(glm::distance(point.position, same->position), tolerance) << seed;
        }
    }
    EXPECT_GT(compared, pairs / 2);
}

OrientedBox mirrored(const OrientedBox& box, int plane)
{
    OrientedBox result = box;
    result.centre[plane] = -box.centre[plane];
    for (const int k : {0, 1, 2}) result.axes[k][plane] = -box.axes[k][plane];
    result.axes[0] = -result.axes[0]; // a rotation again; its first faces are exchanged
    return result;
}

std::uint32_t mirrored(std::uint32_t feature)
{
    constexpr std::uint32_t positive = feature_pair(face_bit(0, true), face_bit(0, true));
    constexpr std::uint32_t negative = feature_pair(face_bit(0, false), face_bit(0, false));
    return (feature & ~(positive | negative)) | (feature & positive) >> 1U |
           (feature & negative) << 1U;
}

TEST(BoxBox, TouchToTheBitLikewiseInAMirror)
{
    for (std::uint64_t seed = 0; seed < pairs; ++seed) {
        Case drawn = draw("mirror", seed);
        const auto& [a, b] = drawn.pair;
        const int plane = static_cast<int>(seed % 3);
        BoxBoxMemory memory = drawn.memory;
        const Manifold here = collide(a, b, drawn.margin, drawn.memory);
        const Manifold there =
            collide(mirrored(a, plane), mirrored(b, plane), drawn.margin, memory);
        ASSERT_EQ(memory.axis, drawn.memory.axis) << seed;
        ASSERT_EQ(here.count, there.count) << seed;
        for (const ContactPoint& point : here.touching()) {
            const ContactPoint* image = found(there, mirrored(point.feature));
            ASSERT_NE(image, nullptr) << seed;
            ASSERT_EQ(point.separation, image->separation) << seed;
            glm::dvec3 position = image->position;
            position[plane] = -position[plane];
            ASSERT_EQ(point.position, position) << seed;
        }
    }
}

// Powers of two do not round: the bits of the mantissas are the same at every size.
TEST(BoxBox, TouchLikewiseAtAnySize)
{
    for (std::uint64_t seed = 0; seed < pairs; ++seed) {
        Case drawn = draw("size", seed);
        const double scale = seed % 2 == 0 ? 0x1p-6 : 0x1p12;
        auto [a, b] = drawn.pair;
        BoxBoxMemory memory = drawn.memory;
        const Manifold here = collide(a, b, drawn.margin, drawn.memory);
        for (OrientedBox* box : {&a, &b}) {
            box->centre *= scale;
            box->half *= scale;
        }
        const Manifold there = collide(a, b, scale * drawn.margin, memory);
        ASSERT_EQ(here.count, there.count) << seed;
        ASSERT_EQ(here.normal, there.normal) << seed;
        for (std::uint32_t k = 0; k < here.count; ++k) {
            ASSERT_EQ(here.points[k].feature, there.points[k].feature) << seed;
            ASSERT_EQ(here.points[k].separation * scale, there.points[k].separation) << seed;
            ASSERT_EQ(here.points[k].position * scale, there.points[k].position) << seed;
        }
    }
}

TEST(BoxBox, GiveFiniteNumbersForBoxesOfAnySizeAnywhereOnEachOther)
{
    for (std::uint64_t seed = 0; seed < 4 * pairs; ++seed) {
        BoxesDrawn drawn{base::Seed{seed}.stream("finite")};
        OrientedBox a = drawn.box(1e-4, 1e6);
        OrientedBox b = drawn.box(1e-4, 1e6);
        if (drawn.one_in(3)) b.axes = a.axes;
        if (drawn.one_in(3)) b.centre = a.centre;
        if (drawn.one_in(3)) b.half = a.half;
        BoxBoxMemory memory{.axis = static_cast<std::int8_t>(drawn.uniform(-1.0, 14.99))};
        const Manifold manifold = collide(a, b, 1e-5, memory);
        ASSERT_LE(manifold.count, manifold_points_max);
        for (const ContactPoint& point : manifold.touching()) {
            const glm::dvec3& place = point.position;
            ASSERT_TRUE(std::isfinite(point.separation + place.x + place.y + place.z)) << seed;
            ASSERT_NEAR(glm::dot(manifold.normal, manifold.normal), 1.0, 1e-9) << seed;
        }
        if (a.centre == b.centre) {
            ASSERT_GT(manifold.count, 0U) << seed;
        }
    }
}

} // namespace
} // namespace hapnet::scene
