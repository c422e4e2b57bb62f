// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/touch.hpp"

#include <gtest/gtest.h>

namespace hapnet::peer {
namespace {

constexpr double rounding = 1e-12;
const Scene scene = paper_scene();

Hand hand_at(double x, bool gripping = false)
{
    return {.hip = {{x, 0.0, 0.0}}, .velocity = {}, .gripping = gripping};
}

Touched feel(Touch& touch, const Hand& hand, double cube_x = 0.0)
{
    Box cube = scene.cube;
    cube.centre = {{cube_x, 0.0, 0.0}};
    return touch.feel(hand, cube, {});
}

TEST(Touch, PushesTheCubeAwayAndFeelsTheOppositeForce)
{
    Touch touch{scene};
    const Touched left = feel(touch, hand_at(-0.023)); // 2 mm deep: 1 N
    EXPECT_TRUE(left.touching);
    EXPECT_FALSE(left.holding);
    EXPECT_NEAR(left.on_cube.x(), 1.0, rounding);
    EXPECT_EQ(left.on_hand, -left.on_cube);

    Touch other{scene};
    EXPECT_NEAR(feel(other, hand_at(0.023)).on_cube.x(), -1.0, rounding);
}

TEST(Touch, NeverPullsWhenItDoesNotGrip)
{
    for (const double speed : {-3.0, -1.0, -0.1, 0.0, 0.1, 3.0}) {
        for (int um = -30'000; um <= -1'000; um += 500) {
            Touch touch{scene};
            Hand hand = hand_at(1e-6 * um);
            std::ignore = feel(touch, hand_at(-0.0249)); // it came from the left
            hand.velocity = {{speed, 0.0, 0.0}};
            const Touched touched = feel(touch, hand);
            EXPECT_GE(touched.on_cube.x(), 0.0) << um << " " << speed;
            EXPECT_LE(touched.on_cube.x(), 3.3) << um << " " << speed;
            EXPECT_EQ(touched.touching, touched.on_cube.x() > 0.0);
        }
    }
}

TEST(Touch, FeelsNothingInTheAir)
{
    Touch touch{scene};
    const Touched touched = feel(touch, hand_at(-0.030));
    EXPECT_FALSE(touched.touching);
    EXPECT_EQ(touched.on_cube, base::Force{});
    EXPECT_EQ(touched.on_hand, base::Force{});
}

TEST(Touch, DampsTheSpeedAtWhichHandAndCubeApproach)
{
    Touch touch{scene};
    Hand hand = hand_at(-0.023);
    hand.velocity = {{0.3, 0.0, 0.0}};
    EXPECT_NEAR(touch.feel(hand, scene.cube, {{0.2, 0.0, 0.0}}).on_cube.x(), 1.2, rounding);
    EXPECT_NEAR(touch.feel(hand, scene.cube, {{0.3, 0.0, 0.0}}).on_cube.x(), 1.0, rounding);
}

TEST(Grip, HoldsBothWaysWhereItTookHold)
{
    Touch touch{scene};
    const Touched taken = feel(touch, hand_at(-0.028, true));
    EXPECT_TRUE(taken.holding);
    EXPECT_TRUE(taken.touching);
    EXPECT_EQ(taken.on_cube, base::Force{});
    EXPECT_NEAR(feel(touch, hand_at(-0.026, true)).on_cube.x(), 1.0, rounding);
    EXPECT_NEAR(feel(touch, hand_at(-0.030, true)).on_cube.x(), -1.0, rounding);
    EXPECT_NEAR(feel(touch, hand_at(-0.028, true), 0.002).on_cube.x(), -1.0, rounding);
}

TEST(Grip, PullsAtMostWithThePeakForceInItsOwnDirection)
{
    Touch touch{scene};
    std::ignore = feel(touch, hand_at(-0.025, true));
    Hand far = hand_at(-0.025 - 0.3, true);
    far.hip.value.y = 0.4;
    const Touched touched = feel(touch, far);
    EXPECT_NEAR(base::norm(touched.on_cube), 3.3, rounding);
    EXPECT_NEAR(touched.on_cube.x(), -0.6 * 3.3, rounding);
    EXPECT_NEAR(touched.on_cube.y(), 0.8 * 3.3, rounding);
}

TEST(Grip, TakesHoldWithin10MmOfTheSurfaceOnly)
{
    Touch touch{scene};
    EXPECT_FALSE(feel(touch, hand_at(-0.0301, true)).holding);
    EXPECT_TRUE(feel(touch, hand_at(-0.0299, true)).holding); // as soon as it comes near
    EXPECT_TRUE(feel(touch, hand_at(-0.100, true)).holding);  // and keeps it
}

TEST(Grip, EndsWhenTheHandOpensOrIsReleased)
{
    Touch touch{scene};
    std::ignore = feel(touch, hand_at(-0.028, true));
    EXPECT_FALSE(feel(touch, hand_at(-0.028, false)).holding);
    EXPECT_TRUE(feel(touch, hand_at(-0.026, true)).holding);
    EXPECT_EQ(feel(touch, hand_at(-0.026, true)).on_cube, base::Force{}); // a new hold
    touch.release();
    EXPECT_EQ(feel(touch, hand_at(-0.029, true)).on_cube, base::Force{}); // newer still
}

TEST(StaticCube, IsFeltButNeitherTouchedNorMoved)
{
    Touch touch{scene};
    Hand hand;
    hand.hip = scene.static_cube.centre;
    hand.hip.value.z += 0.023; // 2 mm deep in its front
    const Touched touched = feel(touch, hand);
    EXPECT_FALSE(touched.touching);
    EXPECT_EQ(touched.on_cube, base::Force{});
    EXPECT_NEAR(touched.on_hand.z(), 1.0, rounding);
    EXPECT_EQ(touched.on_hand.x(), 0.0);
}

} // namespace
} // namespace hapnet::peer
