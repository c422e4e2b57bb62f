// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/finger_friction.hpp"
#include "scene/text/text.hpp"
#include "scene/world.hpp"

#include <gtest/gtest.h>

namespace hapnet::peer {
namespace {

scene::HandDescription rough_hips()
{
    scene::HandDescription hips;
    hips.friction = 0.6;
    return hips;
}

scene::HandInput hand_at(glm::dvec3 position, glm::dvec3 velocity = glm::dvec3{0.0})
{
    return {.position = {position}, .velocity = {velocity}};
}

/// Presses toward +x with this force.
scene::HandTouch pressing(double newtons)
{
    return {.touching = true, .on_body = {{newtons, 0.0, 0.0}}};
}

TEST(FingerFriction, IsASpringAndADamperAlongTheFaceFromWhereTheFingerTouchedFirst)
{
    FingerFriction friction{rough_hips()};
    EXPECT_EQ(friction.on_body(hand_at({-0.02, 0.001, 0.0}), {}), base::Force{});
    friction.on_touch(pressing(2.0));
    EXPECT_EQ(friction.on_body(hand_at({-0.02, 0.001, 0.0}), {}), base::Force{}); // here
    const base::Force force = friction.on_body(hand_at({-0.018, 0.002, 0.0}, {0.0, 0.0, 0.01}), {});
    EXPECT_EQ(force.x(), 0.0); // the world handles the force across the face
    EXPECT_NEAR(force.y(), 500.0 * 0.001, 1e-12);
    EXPECT_NEAR(force.z(), 2.0 * 0.01, 1e-12);
}

TEST(FingerFriction, GivesAtMostItsShareOfTheContactsForceAndItsAnchorSlipsAlong)
{
    FingerFriction friction{rough_hips()};
    friction.on_touch(pressing(1.0));
    std::ignore = friction.on_body(hand_at({0.0, 0.0, 0.0}), {});
    for (int mm = 1; mm <= 10; ++mm) { // 0.6 N are 1.2 mm of the spring
        const base::Force force = friction.on_body(hand_at({0.0, 1e-3 * mm, 0.0}), {});
        EXPECT_NEAR(force.y(), mm == 1 ? 0.5 : 0.6, 1e-12) << mm;
    }
    // After 2.4 mm backwards the friction is as strong in the other direction, and not before.
    EXPECT_NEAR(friction.on_body(hand_at({0.0, 0.0088, 0.0}), {}).y(), 0.0, 1e-12);
    EXPECT_NEAR(friction.on_body(hand_at({0.0, 0.0076, 0.0}), {}).y(), -0.6, 1e-12);
}

TEST(FingerFriction, BeginsAnewAfterTheTouchEndsOrOnAnotherFace)
{
    FingerFriction friction{rough_hips()};
    friction.on_touch(pressing(1.0));
    std::ignore = friction.on_body(hand_at({0.0, 0.0, 0.0}), {});
    friction.on_touch({});
    EXPECT_EQ(friction.on_body(hand_at({0.0, 0.001, 0.0}), {}), base::Force{});
    friction.on_touch(pressing(1.0));
    EXPECT_EQ(friction.on_body(hand_at({0.0, 0.001, 0.0}), {}), base::Force{});
    friction.on_touch({.touching = true, .on_body = {{0.0, 0.0, 1.0}}});
    EXPECT_EQ(friction.on_body(hand_at({0.001, 0.002, 0.0}), {}), base::Force{});
    friction.on_touch({.touching = true, .holding = true, .on_body = {{0.0, 0.0, 1.0}}});
    EXPECT_EQ(friction.on_body(hand_at({0.002, 0.002, 0.0}), {}), base::Force{});
}

TEST(FingerFriction, ForgetsAHandThatIsNotThere)
{
    FingerFriction friction{rough_hips()};
    friction.on_touch(pressing(1.0));
    std::ignore = friction.on_body(hand_at({0.0, 0.0, 0.0}), {});
    scene::HandInput gone = hand_at({0.0, 0.5, 0.0});
    gone.present = false;
    EXPECT_EQ(friction.on_body(gone, {}), base::Force{});
    EXPECT_EQ(friction.on_body(hand_at({0.0, 0.001, 0.0}), {}), base::Force{});
}

TEST(FrictionOfHips, ChangesTheHashOfASceneOnlyWhereThereIsSome)
{
    scene::Description scene = scene::paper_scene();
    const auto smooth = scene::hash(scene);
    EXPECT_EQ(smooth, 2618475813157352714U);
    scene.bodies[0].locked = {};
    EXPECT_EQ(scene::hash(scene), 4717034690440187950U); // as before there was any
    scene.bodies[0].locked = scene::paper_scene().bodies[0].locked;
    scene.hands.friction = 0.6;
    EXPECT_NE(scene::hash(scene), smooth);
}

TEST(FrictionOfHips, IsReadPrintedAndChecked)
{
    const auto scene = scene::parse_scene("[hips]\nfriction = 0.6\n", "s.toml");
    ASSERT_TRUE(scene);
    EXPECT_EQ(scene->hands.friction, 0.6);
    EXPECT_EQ(scene::parse_scene(scene::to_text(*scene), "s.toml"), *scene);
    EXPECT_FALSE(scene::parse_scene("[hips]\nfriction = -0.1\n", "s.toml"));
    scene::Description wrong = scene::paper_scene();
    wrong.hands.friction = 11.0;
    EXPECT_EQ(check(wrong).error().message, "hips: friction is 11; it can be 0 to 10");
}

TEST(SceneLift, LetsTwoFingersLiftTheCubeOffThePlatformAndItComesBack)
{
    // Both hands are in one world. The finger friction is as for two peers.
    const auto description =
        scene::load_scene("lift", [](const std::string& name) -> base::Result<std::string> {
            return base::fail("no file " + name);
        });
    ASSERT_TRUE(description);
    auto world = scene::World::freeze(*description);
    ASSERT_TRUE(world);
    std::array<FingerFriction, 2> friction{FingerFriction{description->hands},
                                           FingerFriction{description->hands}};
    const auto height_after = [&](double finger_from, double finger_to, double depth) {
        for (int ms = 0; ms < 1000; ++ms) {
            const double speed = finger_to - finger_from;
            for (const std::uint32_t i : {0U, 1U}) {
                const double x = (i == 0 ? -1.0 : 1.0) * (0.025 - depth);
                const auto hand =
                    hand_at({x, finger_from + 1e-3 * ms * speed, 0.0}, {0.0, speed, 0.0});
                world->push(0, friction[i].on_body(hand, world->body(0)));
                world->set_hand(i, hand);
            }
            world->tick();
            for (const std::uint32_t i : {0U, 1U}) friction[i].on_touch(world->touch(i));
        }
        return world->body(0).position.y();
    };
    EXPECT_EQ(height_after(0.0, 0.0, 0.0017), 0.0); // squeezed with 0.85 N
    // The fingers' springs give way by 0.5 mm under 0.25 N each.
    EXPECT_NEAR(height_after(0.0, 0.030, 0.0017), 0.030, 0.0012);
    EXPECT_NEAR(height_after(0.030, 0.030, 0.0017), 0.0295, 0.0001); // it stays up there
    EXPECT_NEAR(height_after(0.030, 0.0, 0.0017), 0.0, 0.0005);
    EXPECT_NEAR(height_after(0.0, 0.0, -0.001), 0.0, 1e-9); // let go, on the platform
    EXPECT_EQ(height_after(0.0, 0.030, -0.001), 0.0);       // without a squeeze it stays there
}

} // namespace
} // namespace hapnet::peer
