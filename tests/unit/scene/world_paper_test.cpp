// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The paper's scene, as sessions need it: the motion of its cube, and the force on a hand.
#include "scene/world.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace hapnet::scene {
namespace {

constexpr double stop_x = 0.0747;
constexpr double rounding = 1e-12;
constexpr HandInput away{.present = false};

World paper_world() { return World::freeze(paper_scene()).value(); }

/// The paper's scene with a cube that may also move sideways and upwards.
World unlocked_world()
{
    Description scene = paper_scene();
    scene.bodies[0].locked = {};
    return World::freeze(scene).value();
}

/// Plays ticks of a millisecond with a constant force.
void push(World& world, const glm::dvec3& force, int ticks)
{
    for (int i = 0; i < ticks; ++i) {
        world.push(0, {force});
        world.tick();
    }
}

void place(World& world, const glm::dvec3& position, const glm::dvec3& velocity = {})
{
    BodyState state = world.body(0);
    state.position = {position};
    state.velocity = {velocity};
    world.place(0, state);
}

HandInput hand_at(const glm::dvec3& place, bool gripping = false)
{
    return {.position = {place}, .velocity = {}, .gripping = gripping};
}
HandInput hand_at(double x, bool gripping = false) { return hand_at({x, 0.0, 0.0}, gripping); }

const HandTouch& feel(World& world, const HandInput& hand)
{
    world.set_hand(0, hand);
    world.tick();
    return world.touch(0);
}

TEST(PaperCube, StaysWhereItIsWhenNothingPushesIt)
{
    World world = paper_world();
    for (int i = 0; i < 10'000; ++i) world.tick();
    EXPECT_EQ(world.body(0).position, base::Position{});
    EXPECT_EQ(world.body(0).velocity, base::Velocity{});
}

TEST(PaperCube, EndsAtTheForceOverTheDrag)
{
    World world = paper_world();
    place(world, {-10.0, 0.0, 0.0});
    push(world, {3.3, 0.0, 0.0}, 1000);
    EXPECT_NEAR(world.body(0).velocity.x(), 0.33, rounding);
}

TEST(PaperCube, StopsDeadAtTheStaticCubeAndLeavesItFreely)
{
    World world = paper_world();
    push(world, {3.3, 0.0, 0.0}, 1000);
    EXPECT_NEAR(world.body(0).position.x(), stop_x, rounding);
    EXPECT_EQ(world.body(0).velocity.x(), 0.0);
    push(world, {-1.0, 0.0, 0.0}, 1);
    EXPECT_LT(world.body(0).position.x(), stop_x);
}

TEST(PaperCube, MovesAlongXAloneWhateverPushesIt)
{
    World world = paper_world();
    push(world, {-1.0, 3.3, -3.3}, 500);
    EXPECT_EQ(world.body(0).position.y(), 0.0);
    EXPECT_EQ(world.body(0).position.z(), 0.0);
    EXPECT_NEAR(world.body(0).velocity.x(), -0.1, rounding); // the drag acts all the same
    push(world, {3.3, 0.0, -3.3}, 1000);
    EXPECT_NEAR(world.body(0).position.x(), stop_x, rounding); // not past the static cube
}

TEST(PaperCube, PredictedIntoTheStaticCubeIsPutBackInFrontOfItAndNotBesideIt)
{
    for (const double depth : {0.001, 0.011, 0.020, 0.039}) { // beyond 10 mm z would be nearer
        World world = paper_world();
        place(world, {stop_x + depth, 0.0, 0.0}, {0.3, 0.0, 0.0});
        world.tick();
        EXPECT_NEAR(world.body(0).position.x(), stop_x, rounding) << depth;
        EXPECT_EQ(world.body(0).position.z(), 0.0) << depth;
    }
}

TEST(UnlockedCube, SlidesAlongTheStaticCubeAndPastItsCorner)
{
    World world = unlocked_world();
    push(world, {3.3, 0.0, -1.0}, 1000);
    // z under drag: v (t - T (1 - exp(-t / T))), v = F / b, T = m / b.
    EXPECT_NEAR(world.body(0).position.z(), -0.1 * (1.0 - 0.01 * (1.0 - std::exp(-100.0))),
                rounding);
    EXPECT_GT(world.body(0).position.x(), stop_x);
}

TEST(UnlockedCube, StopsAtTheFaceOfTheStaticCubeThatItComesTo)
{
    World world = unlocked_world();
    place(world, {0.1147, 0.0, -0.1}); // behind it
    push(world, {0.0, 0.0, 1.0}, 3000);
    EXPECT_NEAR(world.body(0).position.z(), 0.030 - 0.040, rounding);
    EXPECT_EQ(world.body(0).position.x(), 0.1147);
}

TEST(PaperCube, PlacedAHairInsideTheStaticCubeDoesNotPassThroughIt)
{
    World world = paper_world();
    place(world, {stop_x + 1e-8, 0.0, 0.0}); // as a rounding on the wire may leave it
    push(world, {3.3, 0.0, 0.0}, 1000);
    EXPECT_NEAR(world.body(0).position.x(), stop_x, rounding);
}

TEST(PaperCube, LockedOntoThePlatformIsSlowedByTheDragWhateverPullsItUp)
{
    Description scene = paper_scene();
    scene.bodies[0].locked.y = true;
    for (const StepperKind kind : {StepperKind::sliding, StepperKind::lone, StepperKind::few}) {
        for (const double up : {0.0, 0.98, 0.982, 3.3}) { // it weighs 0.981 N
            World world = World::freeze(scene, {.stepper = kind}).value();
            place(world, {}, {0.2, 0.0, 0.0});
            push(world, {0.0, up, 0.0}, 500); // 50 time constants of 0.1 kg / (10 N s/m)
            EXPECT_NEAR(world.body(0).position.x(), 0.2 * 0.01, rounding)
                << name_of(kind) << ' ' << up;
        }
    }
}

TEST(UnlockedCube, FallsBackOntoThePlatformAndStaysThere)
{
    World world = unlocked_world();
    place(world, {0.0, 0.1, 0.0}, {0.2, 0.0, 0.0});
    push(world, {}, 100);
    EXPECT_NEAR(world.body(0).position.y(), 0.1 - 0.5 * 9.81 * 0.01, rounding);
    EXPECT_EQ(world.body(0).velocity.x(), 0.2); // no drag in the air
    push(world, {}, 200);
    EXPECT_EQ(world.body(0).position.y(), 0.0);
    EXPECT_EQ(world.body(0).velocity.y(), 0.0);
    push(world, {0.0, -5.0, 0.0}, 100);
    EXPECT_EQ(world.body(0).position.y(), 0.0);
}

TEST(UnlockedCube, IsLiftedByMoreThanItsWeightOnly)
{
    World world = unlocked_world();
    push(world, {0.0, 0.98, 0.0}, 100); // 0.981 N
    EXPECT_EQ(world.body(0).position.y(), 0.0);
    push(world, {0.0, 1.2, 0.0}, 100);
    EXPECT_NEAR(world.body(0).position.y(), 0.5 * (1.2 - 0.981) / 0.1 * 0.01, rounding);
}

TEST(PaperCube, HasEnoughDragForSoftnessToGrowWithDelay)
{
    const Description scene = paper_scene();
    EXPECT_GE(scene.bodies[0].drag_ns_per_m,
              std::sqrt(2.0 * scene.hands.stiffness_n_per_m * scene.bodies[0].mass_kg) *
                  (1.0 - rounding));
}

TEST(PaperHand, PushesTheCubeAndFeelsTheOppositeForce)
{
    for (const double side : {-1.0, 1.0}) {
        World world = paper_world();
        const HandTouch& touched = feel(world, hand_at(side * 0.023)); // 2 mm deep: 1 N
        EXPECT_TRUE(touched.touching);
        EXPECT_FALSE(touched.holding);
        EXPECT_NEAR(touched.depth_m, 0.002, rounding);
        EXPECT_NEAR(touched.on_hand_at_start.x(), side * 1.0, rounding);
        EXPECT_EQ(touched.on_hand, -touched.on_body);
        EXPECT_GT(-side * touched.on_body.x(), 0.9); // the mean: the cube gives way
        EXPECT_LT(-side * touched.on_body.x(), 1.0);
    }
}

TEST(PaperHand, GivesTheCubeTheImpulseThatItTellsOf)
{
    Description scene = paper_scene();
    scene.bodies[0].drag_ns_per_m = 0.0;
    World world = World::freeze(scene).value();
    double impulse = 0.0;
    for (int i = 0; i < 30; ++i) impulse += 1e-3 * feel(world, hand_at(-0.023)).on_body.x();
    EXPECT_NEAR(impulse, 0.1 * world.body(0).velocity.x(), rounding);
}

TEST(PaperHand, NeverPullsWhenItDoesNotGrip)
{
    const World fresh = paper_world();
    for (const double speed : {-3.0, -1.0, -0.1, 0.0, 0.1, 3.0}) {
        for (int um = -30'000; um <= -1'000; um += 500) {
            World world = fresh;
            std::ignore = feel(world, hand_at(-0.0249)); // it came from the left
            HandInput hand = hand_at(1e-6 * um);
            hand.velocity = {{speed, 0.0, 0.0}};
            const HandTouch& touched = feel(world, hand);
            EXPECT_GE(touched.on_body.x(), 0.0) << um << " " << speed;
            EXPECT_LE(touched.on_body.x(), 3.3) << um << " " << speed;
            EXPECT_EQ(touched.touching, touched.on_body.x() > 0.0) << um << " " << speed;
        }
    }
}

TEST(PaperHand, FeelsNothingInTheAir)
{
    World world = paper_world();
    for (const HandInput& hand : {hand_at(-0.030), hand_at({0.0, -0.022, -0.1}), away}) {
        const HandTouch& touched = feel(world, hand); // not the platform either
        EXPECT_FALSE(touched.touching);
        EXPECT_EQ(touched.on_body, base::Force{});
        EXPECT_EQ(touched.on_hand, base::Force{});
    }
}

TEST(PaperHand, DampsTheSpeedAtWhichHandAndCubeApproach)
{
    for (const double cube_speed : {0.2, 0.3}) {
        World world = paper_world();
        place(world, {}, {cube_speed, 0.0, 0.0});
        HandInput hand = hand_at(-0.023);
        hand.velocity = {{0.3, 0.0, 0.0}};
        EXPECT_NEAR(feel(world, hand).on_hand_at_start.x(), -1.0 - 2.0 * (0.3 - cube_speed),
                    rounding);
    }
}

TEST(PaperHand, AtAnEdgePushesFromTheEdgeToTheSphere)
{
    World world = paper_world();
    const HandTouch& touched = feel(world, hand_at({-0.023, 0.022, 0.010}));
    const double gap = std::sqrt(9e-6 + 4e-6); // 3 mm and 2 mm past the faces
    const double force = 500.0 * (0.005 - gap);
    EXPECT_NEAR(touched.depth_m, 0.005 - gap, rounding);
    EXPECT_NEAR(touched.on_hand_at_start.x(), -force * 0.003 / gap, rounding);
    EXPECT_NEAR(touched.on_hand_at_start.y(), force * 0.002 / gap, rounding);
    EXPECT_EQ(touched.on_hand_at_start.z(), 0.0);
    EXPECT_FALSE(feel(world, hand_at({-0.0241, 0.0231, 0.010})).touching); // more than 5 mm
}

TEST(PaperHand, FeelsTheWholeSpringOfACubeThatCannotGiveWaySidewaysOrDownwards)
{
    for (const glm::dvec3 side : {glm::dvec3{0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}, {0.0, 1.0, 0.0}}) {
        World world = paper_world();
        HandInput hand = hand_at(0.023 * side); // 2 mm deep: 1 N
        for (int i = 0; i < 100; ++i) {
            const HandTouch& touched = feel(world, hand);
            ASSERT_NEAR(glm::dot(touched.on_hand.value, side), 1.0, rounding);
            ASSERT_EQ(touched.on_hand, -touched.on_body);
        }
        hand.velocity = {-0.1 * side};
        EXPECT_NEAR(glm::dot(feel(world, hand).on_hand_at_start.value, side), 1.2, rounding);
        EXPECT_NEAR(glm::dot(world.touch(0).on_hand.value, side), 1.225, rounding); // the mean
        EXPECT_EQ(world.body(0).position, base::Position{});
    }
}

TEST(PaperHand, LeavesTheStaticCubeByTheFaceThroughWhichItWentIn)
{
    World world = paper_world();
    const glm::dvec3 centre = paper_scene().bodies[1].position.value;
    for (int um = 26'000; um >= -15'000; um -= 500) {
        const double out = 1e-6 * um;
        const HandTouch& touched = feel(world, hand_at(centre + glm::dvec3{out, 0.004, -0.002}));
        if (um >= 25'000) continue;
        EXPECT_NEAR(touched.depth_m, 0.025 - out, rounding) << um;
        EXPECT_GT(touched.on_hand.x(), 0.0) << um;
        EXPECT_EQ(touched.on_hand.y(), 0.0) << um;
    }
    feel(world, hand_at(1.0)); // out of it
    const HandTouch& suddenly = feel(world, hand_at(centre + glm::dvec3{0.001, 0.018, -0.002}));
    EXPECT_NEAR(suddenly.depth_m, 0.005 + 0.002, rounding); // the nearest face
    EXPECT_GT(suddenly.on_hand.y(), 0.0);
}

TEST(PaperHand, FeelsTheStaticCubeWithoutTouchingOrMovingAnything)
{
    World world = paper_world();
    const glm::dvec3 centre = paper_scene().bodies[1].position.value;
    const HandTouch& touched = feel(world, hand_at(centre + glm::dvec3{0.0, 0.0, 0.023}));
    EXPECT_FALSE(touched.touching);
    EXPECT_EQ(touched.on_body, base::Force{});
    EXPECT_NEAR(touched.on_hand.z(), 1.0, rounding);
    EXPECT_EQ(touched.on_hand.x(), 0.0);
    EXPECT_EQ(world.body(0).position, base::Position{});
}

TEST(PaperGrip, HoldsBothWaysWhereItTookHold)
{
    World world = paper_world();
    const HandTouch& touched = feel(world, hand_at(-0.028, true));
    EXPECT_TRUE(touched.holding);
    EXPECT_TRUE(touched.touching);
    EXPECT_EQ(touched.on_body, base::Force{});
    for (const double x : {-0.026, -0.030, -0.027}) {
        const BodyState cube = world.body(0);
        feel(world, hand_at(x, true));
        const double stretch = x - (cube.position.x() - 0.028);
        EXPECT_NEAR(-touched.on_hand_at_start.x(), 500.0 * stretch - 2.0 * cube.velocity.x(),
                    rounding);
        EXPECT_EQ(touched.on_body.x() > 0.0, stretch > 0.0) << x;
    }
}

TEST(PaperGrip, PullsAtMostWithThePeakForceInItsOwnDirection)
{
    World world = paper_world();
    feel(world, hand_at(-0.025, true));
    const HandTouch& touched = feel(world, hand_at({-0.325, 0.4, 0.0}, true));
    EXPECT_NEAR(base::norm(touched.on_body), 3.3, rounding);
    EXPECT_NEAR(touched.on_body.x(), -0.6 * 3.3, rounding);
    EXPECT_NEAR(touched.on_body.y(), 0.8 * 3.3, rounding);
}

TEST(PaperGrip, CarriesTheCubeAlongXAndIsHeldBackAcross)
{
    World world = paper_world();
    feel(world, hand_at(-0.025, true));
    for (int i = 0; i < 1000; ++i) feel(world, hand_at({-0.030, 0.003, -0.002}, true));
    const HandTouch& touched = world.touch(0);
    EXPECT_NEAR(world.body(0).position.x(), -0.005, 1e-6);
    EXPECT_EQ(world.body(0).position.y(), 0.0);
    EXPECT_EQ(world.body(0).position.z(), 0.0);
    EXPECT_NEAR(touched.on_hand.x(), 0.0, 1e-3);
    EXPECT_NEAR(touched.on_hand.y(), -1.5, rounding); // 3 mm
    EXPECT_NEAR(touched.on_hand.z(), 1.0, rounding);  // 2 mm
}

TEST(PaperGrip, TakesHoldWithin10MmOfTheSurfaceOnlyAndKeepsIt)
{
    World world = paper_world();
    EXPECT_FALSE(feel(world, hand_at(-0.0301, true)).holding);
    EXPECT_TRUE(feel(world, hand_at(-0.0299, true)).holding);
    EXPECT_TRUE(feel(world, hand_at(-0.100, true)).holding);
}

TEST(PaperGrip, EndsWhenTheHandOpensOrIsAway)
{
    for (const HandInput& end : {hand_at(-0.028), away}) {
        World world = paper_world();
        EXPECT_TRUE(feel(world, hand_at(-0.028, true)).holding);
        EXPECT_FALSE(feel(world, end).holding);
        const HandTouch& anew = feel(world, hand_at(-0.027, true));
        EXPECT_TRUE(anew.holding);
        EXPECT_EQ(anew.on_body, base::Force{}); // a new hold, where it is now
    }
}

} // namespace
} // namespace hapnet::scene
