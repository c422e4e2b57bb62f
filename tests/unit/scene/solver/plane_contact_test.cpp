// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/solver/plane_contact.hpp"

#include "scene/maths/rotation.hpp"
#include "tests/support/scene/dice.hpp"

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace hapnet::scene::plane_contact_test {
namespace {

/// A box that comes to lie on a plane, tips and turns.
struct Scene {
    glm::dvec3 normal{0.0, 1.0, 0.0};
    glm::dvec3 half{0.02, 0.03, 0.01};
    glm::dvec3 centre{0.01, 0.01, -0.02};
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
    double margin = 0.02;
    ContactMemory memory;

    [[nodiscard]] glm::dmat3 axes() const { return axes_of(orientation); }
};

/// The same contact as a manifold of points in the world.
Manifold manifold_of(const Scene& scene)
{
    Manifold manifold;
    manifold.normal = scene.normal;
    for (const PlaneCorner& corner : deepest_corners(scene.normal, scene.axes(), scene.half)) {
        const glm::dvec3 place = scene.centre + corner.place;
        const double separation = glm::dot(scene.normal, place);
        if (separation > scene.margin) continue;
        manifold.points[manifold.count++] = {place - 0.5 * separation * scene.normal, separation,
                                             corner.feature};
    }
    return manifold;
}

std::uint32_t find(PlaneContact& contact, const Scene& scene)
{
    const glm::dmat3 axes = scene.axes();
    return contact.find({3, 1, scene.normal, glm::dot(scene.normal, scene.centre), scene.margin,
                         axes, scene.orientation, scene.half});
}

void change(Scene& scene, test::Dice& dice)
{
    if (dice.one_in(3)) scene.centre = 0.03 * dice.vector();
    if (dice.one_in(5)) scene.orientation = rotated(scene.orientation, 0.1 * dice.vector());
    if (dice.one_in(9)) scene.margin = dice.between(0.0, 0.05);
    if (!dice.one_in(4)) return;
    const auto corners = deepest_corners(scene.normal, scene.axes(), scene.half);
    scene.memory.count = static_cast<std::uint32_t>(dice.below(5));
    for (std::size_t i = 0; i < scene.memory.count; ++i) {
        scene.memory.feature[i] = corners[(i + dice.below(2)) % corners.size()].feature;
        scene.memory.normal_impulse[i] = dice.one_in(3) ? 0.0 : dice.share();
    }
    const glm::dvec3 push = dice.vector();
    scene.memory.friction_impulse = push - glm::dot(push, scene.normal) * scene.normal;
    scene.memory.torsion_impulse = dice.sign();
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double within)
{
    const glm::dvec3 apart = a - b;
    EXPECT_LE(std::sqrt(glm::dot(apart, apart)), within);
}

TEST(PlaneContact, IsTheManifoldOfTheCornersThatComeUpToTheMargin)
{
    test::Dice dice{base::Seed{5}.stream("plane")};
    Scene scene;
    scene.normal = glm::normalize(glm::dvec3{0.2, 0.9, -0.1});
    PlaneContact contact;
    int touching = 0;
    for (int i = 0; i < 2000; ++i) {
        change(scene, dice);
        const Manifold manifold = manifold_of(scene);
        ASSERT_EQ(find(contact, scene), manifold.count);
        if (manifold.count == 0) continue;
        ++touching;
        ContactBlock block, expected;
        contact.prepare(block, scene.memory);
        prepare(expected, manifold, {scene.centre, scene.centre}, scene.memory);
        ASSERT_EQ(block.count, expected.count);
        EXPECT_EQ(block.normal, expected.normal);
        EXPECT_EQ(block.tangent_1, expected.tangent_1);
        EXPECT_EQ(block.impulse.normal, expected.impulse.normal);
        EXPECT_EQ(block.impulse.tangent_2, expected.impulse.tangent_2);
        constexpr double rounding = 1e-15;
        expect_near(block.arm_b, expected.arm_b, rounding);
        expect_near(block.start_push.impulse, expected.start_push.impulse, rounding);
        expect_near(block.start_push.angular, expected.start_push.angular, rounding);
        EXPECT_NEAR(block.torsion_arm, expected.torsion_arm, rounding);
        for (std::uint32_t k = 0; k < block.count; ++k) {
            EXPECT_EQ(block.feature[k], expected.feature[k]);
            EXPECT_NEAR(block.separation[k], expected.separation[k], rounding);
            EXPECT_NEAR(block.along_1[k], expected.along_1[k], rounding);
            EXPECT_NEAR(block.along_2[k], expected.along_2[k], rounding);
        }
    }
    EXPECT_GT(touching, 500);
}

TEST(PlaneContact, ThatIsKeptFromTickToTickHasTheBitsOfANewOne)
{
    test::Dice dice{base::Seed{6}.stream("plane")};
    Scene scene;
    PlaneContact kept;
    for (int i = 0; i < 2000; ++i) {
        change(scene, dice);
        PlaneContact fresh;
        const std::uint32_t count = find(kept, scene);
        ASSERT_EQ(count, find(fresh, scene));
        EXPECT_EQ(kept.lies_on(1e-3), fresh.lies_on(1e-3));
        if (count == 0) continue;
        ContactBlock a, b;
        kept.prepare(a, scene.memory);
        fresh.prepare(b, scene.memory);
        EXPECT_EQ(a.arm_b, b.arm_b);
        EXPECT_EQ(a.torsion_arm, b.torsion_arm);
        EXPECT_EQ(a.along_1, b.along_1);
        EXPECT_EQ(a.along_2, b.along_2);
        EXPECT_EQ(a.start_impulse, b.start_impulse);
        EXPECT_EQ(a.start_push.impulse, b.start_push.impulse);
        EXPECT_EQ(a.start_push.angular, b.start_push.angular);
        for (std::uint32_t k = 0; k < count; ++k) {
            EXPECT_EQ(a.separation[k], b.separation[k]);
            EXPECT_EQ(a.feature[k], b.feature[k]);
        }
    }
}

TEST(PlaneContact, CountsCornersUpToTheMarginAndNotAHairFarther)
{
    Scene scene;
    scene.half = {0.5, 0.25, 2.0};
    scene.centre = {3.0, 0.375, 5.0};
    scene.margin = 0.125;
    PlaneContact contact;
    EXPECT_EQ(find(contact, scene), 4U);
    EXPECT_TRUE(contact.lies_on(0.125));
    EXPECT_FALSE(contact.lies_on(0.12));
    scene.centre.y += 1e-12;
    EXPECT_EQ(find(contact, scene), 0U);
}

} // namespace
} // namespace hapnet::scene::plane_contact_test
