// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Bodies and hands in bad places: inside each other, at edges, suddenly elsewhere.
#include "scene/world.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace hapnet::scene {
namespace {

constexpr double half_edge = 0.02;

BodyDescription cube(const glm::dvec3& at)
{
    BodyDescription body;
    body.position.value = at;
    body.material.friction = 0.3;
    return body;
}

Description on_a_floor(std::vector<BodyDescription> bodies)
{
    Description scene;
    scene.planes.push_back({.name = "floor", .offset_m = -half_edge, .material = {0.3, 0.0}});
    scene.bodies = std::move(bodies);
    return scene;
}

double fastest(const World& world, BodyId bodies)
{
    double most = 0.0;
    for (BodyId id = 0; id < bodies; ++id) {
        const BodyState state = world.body(id);
        const double spin = std::sqrt(glm::dot(state.angular_velocity, state.angular_velocity));
        most = std::max(most, base::norm(state.velocity) + spin * half_edge);
    }
    return most;
}

TEST(Overlap, BodiesDeepInEachOtherAndInTheFloorPartWithoutSpeed)
{
    for (const double deep : {0.001, 0.01, 0.02, 0.035}) {
        const Description scene =
            on_a_floor({cube({0.0, -0.5 * deep, 0.0}), cube({2.0 * half_edge - deep, 0.0, 0.003}),
                        cube({half_edge, 2.0 * half_edge - deep, 0.0})});
        World world = World::freeze(scene).value();
        double most = 0.0;
        for (int i = 0; i < 600; ++i) {
            world.tick();
            most = std::max(most, fastest(world, 3));
        }
        // At most it falls off the others.
        EXPECT_LE(most, std::sqrt(2.0 * 9.81 * 4.0 * half_edge)) << deep;
        for (BodyId id = 0; id < 3; ++id) {
            EXPECT_GE(world.body(id).position.y(), -1e-4) << deep << ' ' << id;
        }
    }
}

TEST(Overlap, ABodyAtTheVeryPlaceOfAnotherStaysFiniteAndSlow)
{
    const Description scene =
        on_a_floor({cube(glm::dvec3{0.0}), cube(glm::dvec3{0.0}), cube(glm::dvec3{0.0})});
    World world = World::freeze(scene).value();
    for (int i = 0; i < 300; ++i) {
        world.tick();
        ASSERT_LE(fastest(world, 3), 2.0);
    }
}

TEST(Hands, AppearInsideAndAnywhereWithNoMoreThanTheirGreatestForce)
{
    const Description scene = on_a_floor({cube(glm::dvec3{0.0}), cube({0.04, 0.0, 0.0})});
    for (const StepperKind kind : {StepperKind::few, StepperKind::many}) {
        World world = World::freeze(scene, {.stepper = kind}).value();
        int place = 0;
        for (int i = 0; i < 500; ++i) {
            for (const std::uint32_t hand : {0U, 1U}) {
                place = (place * 31 + 7) % 1000;
                const double x = 0.08 * place / 1000.0 - 0.02;
                const double y = 0.0001 * ((place * 17) % 400) - 0.02;
                ASSERT_FALSE(world.set_hand(
                    hand, {.position = {{x, y, 0.5 * y}}, .velocity = {}, .gripping = i % 7 == 0}));
            }
            world.tick();
            for (const std::uint32_t hand : {0U, 1U}) {
                ASSERT_LE(base::norm(world.touch(hand).on_body), scene.hands.force_max_n + 1e-5);
            }
            // Two hands' greatest force on a body of 100 g for half a second: far more than this.
            ASSERT_LE(fastest(world, 2), 20.0) << i;
        }
    }
}

TEST(Hands, GrazeFacesEdgesAndCornersWithoutAJerk)
{
    // A weak spring that grazes along an edge and over a corner. The force never changes by more
    // than the hand's motion in a tick explains.
    for (const double beside : {-1e-3, -1e-9, 0.0, 1e-9, 1e-3, 4.9e-3}) {
        Description scene = on_a_floor({cube(glm::dvec3{0.0})});
        scene.hands.damping_ns_per_m = 0.0;
        scene.hands.stiffness_n_per_m = 100.0;
        World world = World::freeze(scene).value();
        const double speed = 0.1;
        double before = 0.0;
        for (int i = 0; i < 600; ++i) {
            const double x = -0.03 + 1e-3 * speed * i;
            ASSERT_FALSE(
                world.set_hand(0, {.position = {{x, half_edge + 0.0049, half_edge + beside}},
                                   .velocity = {{speed, 0.0, 0.0}}}));
            world.tick();
            const double force = base::norm(world.touch(0).on_hand_at_start);
            ASSERT_LE(std::abs(force - before), 100.0 * 2.0 * 1e-3 * speed) << beside << ' ' << i;
            before = force;
        }
    }
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

class AnyProfile : public testing::TestWithParam<StepperKind> {
protected:
    [[nodiscard]] static World world()
    {
        Description scene = paper_scene();
        scene.bodies[0].locked = {};
        if (GetParam() >= StepperKind::few) scene.bodies.push_back(cube({-0.1, 0.0, 0.0}));
        if (GetParam() == StepperKind::flight) {
            scene.bodies.erase(scene.bodies.begin() + 1);
            scene.planes.clear();
            scene.hands.count = 0;
        }
        return World::freeze(scene, {.stepper = GetParam()}).value();
    }
    static void play(World& world, int ticks)
    {
        for (int i = 0; i < ticks; ++i) {
            const double x = -0.03 + 1e-5 * static_cast<double>(world.ticks());
            std::ignore = world.set_hand(0, {.position = {{x, 0.0, 0.0}}});
            std::ignore = world.push(0, {{0.0, 0.0, 0.01}});
            world.tick();
        }
    }
    /// Tries `bad` everywhere; returns how many were not refused.
    static int try_everywhere(World& world, double bad)
    {
        int taken = 0;
        for (const int axis : {0, 1, 2}) {
            glm::dvec3 v{0.0};
            v[axis] = bad;
            taken += int{!world.set_hand(0, {.position = {v}})} +
                     int{!world.set_hand(1, {.velocity = {v}})} + int{!world.push(0, {v})} +
                     int{!world.place(0, {.position = {v}})} +
                     int{!world.place(0, {.velocity = {v}})} +
                     int{!world.place(0, {.angular_velocity = v})} +
                     int{!world.place(0, {.orientation = {1.0, v.x, v.y, v.z}})};
        }
        return taken + int{!world.place(0, {.orientation = {bad, 0.0, 0.0, 0.0}})};
    }
};

TEST_P(AnyProfile, RefusesWhatIsNoNumberInEveryInputAndGoesOnAsIfNothingHadBeen)
{
    World on_body_placed = world();
    World calm = world();
    play(on_body_placed, 100);
    play(calm, 100);
    for (const double bad : {nan, -nan, infinity, -infinity, 1e30, -1e30, 1e308}) {
        EXPECT_EQ(try_everywhere(on_body_placed, bad), 0) << bad;
        EXPECT_EQ(on_body_placed.hash(), calm.hash());
        play(on_body_placed, 5);
        play(calm, 5);
        EXPECT_EQ(on_body_placed.hash(), calm.hash());
    }
}

INSTANTIATE_TEST_SUITE_P(Input, AnyProfile,
                         testing::Values(StepperKind::flight, StepperKind::sliding,
                                         StepperKind::sliding_coulomb, StepperKind::lone,
                                         StepperKind::few, StepperKind::many),
                         [](const auto& each) {
                             std::string name{name_of(each.param)};
                             std::erase(name, '-');
                             return name;
                         });

TEST(Sleepers, LieStillUntilWhatMovesTouchesThem)
{
    for (const StepperKind kind : {StepperKind::few, StepperKind::many}) {
        const Description scene = on_a_floor({cube(glm::dvec3{0.0}), cube({0.1, 0.0, 0.0})});
        World world = World::freeze(scene, {.stepper = kind}).value();
        for (int i = 0; i < 300; ++i) world.tick();
        ASSERT_FALSE(world.is_awake(0) || world.is_awake(1));
        EXPECT_EQ(fastest(world, 2), 0.0);
        ASSERT_FALSE(
            world.place(0, {.position = {{0.03, 0.0, 0.0}}, .velocity = {{0.5, 0.0, 0.0}}}));
        bool was_touched = false;
        for (int i = 0; i < 200 && !was_touched; ++i) {
            world.tick();
            const double gap = world.body(1).position.x() - world.body(0).position.x();
            EXPECT_GE(gap, 2.0 * half_edge - 1e-6);
            was_touched = world.is_awake(1);
            // A sleeping body has not moved, and no moving body has entered it.
            if (!was_touched) {
                EXPECT_EQ(world.body(1).position.x(), 0.1);
            }
        }
        EXPECT_TRUE(was_touched) << name_of(kind);
        for (int i = 0; i < 5; ++i) world.tick();
        EXPECT_GT(world.body(1).position.x(), 0.1);
    }
}

} // namespace
} // namespace hapnet::scene
