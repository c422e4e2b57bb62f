// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/world.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace hapnet::scene::world_test {
namespace {

using namespace std::chrono_literals;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

World paper_world() { return World::freeze(paper_scene()).value(); }

/// Ten cubes side by side on a platform, the first of which a hand pushes.
Description row_of_cubes()
{
    Description scene = paper_scene();
    scene.bodies.clear();
    for (int i = 0; i < 10; ++i) {
        BodyDescription cube;
        cube.position = {{0.05 * i, 0.0, 0.0}};
        cube.material.friction = 0.3;
        scene.bodies.push_back(cube);
    }
    scene.planes[0].material.friction = 0.3;
    return scene;
}

HandInput hand_at(double x, double speed = 0.0)
{
    return {.position = {{x, 0.0, 0.0}}, .velocity = {{speed, 0.0, 0.0}}};
}

void expect_refused(World& world, Refusal why, const std::optional<Refusal>& answer)
{
    const std::size_t cause = static_cast<std::size_t>(why);
    EXPECT_EQ(answer, why);
    EXPECT_GT(world.refused()[cause], 0U);
}

TEST(World, RefusesAndCountsWhatIsNotFiniteOrOutOfRangeAndStaysAsItWas)
{
    World world = paper_world();
    ASSERT_FALSE(world.set_hand(0, hand_at(-0.0245)));
    for (int i = 0; i < 10; ++i) world.tick();
    const auto before = world.hash();
    for (const double bad : {nan, infinity, -infinity, 1e30, -1e30}) {
        const Refusal why = std::abs(bad) == 1e30 ? Refusal::out_of_range : Refusal::not_finite;
        expect_refused(world, why, world.set_hand(0, hand_at(bad)));
        expect_refused(world, why, world.set_hand(0, hand_at(0.0, bad)));
        expect_refused(world, why, world.push(0, {{0.0, bad, 0.0}}));
        BodyState state = world.body(0);
        state.position.value.z = bad;
        expect_refused(world, why, world.place(0, state));
        state = world.body(0);
        state.angular_velocity.x = bad;
        expect_refused(world, why, world.place(0, state));
        state = world.body(0);
        state.orientation.w = bad;
        EXPECT_TRUE(world.place(0, state));
    }
    EXPECT_EQ(world.hash(), before);
    World undisturbed = paper_world();
    ASSERT_FALSE(undisturbed.set_hand(0, hand_at(-0.0245)));
    for (int i = 0; i < 10; ++i) undisturbed.tick();
    world.tick();
    undisturbed.tick();
    EXPECT_EQ(world.hash(), undisturbed.hash());
}

TEST(World, RefusesBodiesAndHandsThatAreNotThere)
{
    World world = paper_world();
    expect_refused(world, Refusal::no_such_hand, world.set_hand(2, hand_at(0.0)));
    expect_refused(world, Refusal::no_such_body, world.push(1, {})); // fixed
    expect_refused(world, Refusal::no_such_body, world.place(2, {}));
}

TEST(World, PushesOfOneTickAddUpAndAreGoneInTheNext)
{
    Description scene = paper_scene();
    scene.bodies[0].drag_ns_per_m = 0.0;
    scene.planes.clear();
    scene.gravity = glm::dvec3{0.0};
    World world = World::freeze(scene).value();
    ASSERT_FALSE(world.push(0, {{1.0, 0.0, 0.0}}));
    ASSERT_FALSE(world.push(0, {{1.0, 0.0, 0.0}}));
    world.tick();
    const double gained = 2.0 / 0.1 * 1e-3;
    EXPECT_NEAR(world.body(0).velocity.x(), gained, 1e-15);
    world.tick();
    EXPECT_NEAR(world.body(0).velocity.x(), gained, 1e-15);
}

TEST(World, ALockedBodyCannotBePlacedTurned)
{
    World world = paper_world();
    BodyState rotated = world.body(0);
    rotated.orientation = {0.8, 0.0, 0.6, 0.0};
    expect_refused(world, Refusal::out_of_range, world.place(0, rotated));
}

TEST(World, ALockedCoordinateStaysWhereItIsWhereverTheBodyIsPut)
{
    Description scene = paper_scene();
    scene.bodies[0].locked = {.z = true};
    World world = World::freeze(scene).value();
    BodyState state;
    state.position = {{0.01, 0.02, 0.03}};
    state.velocity = {{0.1, 0.2, 0.3}};
    ASSERT_FALSE(world.place(0, state));
    EXPECT_EQ(world.body(0).position, (base::Position{{0.01, 0.02, 0.0}}));
    EXPECT_EQ(world.body(0).velocity, (base::Velocity{{0.1, 0.2, 0.0}}));
}

TEST(World, ABodyPutSomewhereKeepsItsTurnAndSpin)
{
    Description scene = row_of_cubes();
    scene.bodies[0].locked.z = true;
    scene.bodies[0].angular_velocity = glm::dvec3{0.0, 3.0, 0.0};
    World world = World::freeze(scene).value();
    for (int i = 0; i < 10; ++i) world.tick();
    World other = world;
    BodyState state = other.body(0);
    state.position = {{-0.03, 0.02, 0.5}};
    state.velocity = {{0.1, 0.2, 0.3}};
    ASSERT_FALSE(other.place(0, state));
    ASSERT_FALSE(world.place(0, state.position, state.velocity));
    EXPECT_EQ(world.position(0), other.body(0).position);
    EXPECT_EQ(world.velocity(0), other.body(0).velocity);
    EXPECT_EQ(world.body(0).orientation, other.body(0).orientation);
    expect_refused(world, Refusal::not_finite, world.place(0, {{nan, 0.0, 0.0}}, {}));
    expect_refused(world, Refusal::out_of_range, world.place(0, {}, {{1e30, 0.0, 0.0}}));
    expect_refused(world, Refusal::no_such_body, world.place(10, {}, {}));
    EXPECT_EQ(world.position(0), other.body(0).position);
}

TEST(World, FreezeSaysWhatIsWrong)
{
    Description scene = paper_scene();
    scene.bodies[0].mass_kg = 0.0;
    const auto without_mass = World::freeze(scene);
    ASSERT_FALSE(without_mass);
    EXPECT_EQ(without_mass.error().message,
              "body 1 'cube': mass in kg is 0; it can be 1e-06 to 1000000");
    EXPECT_FALSE(World::freeze(paper_scene(), {.tick = 1us}));
    const auto too_little = World::freeze(paper_scene(), {.stepper = StepperKind::flight});
    ASSERT_FALSE(too_little);
    EXPECT_EQ(too_little.error().message,
              "the stepper 'flight' cannot do what the scene needs; 'sliding' can");
}

/// Drives a hand to and fro into the first body.
void play(World& world, int ticks)
{
    for (int i = 0; i < ticks; ++i) {
        const double phase = 0.002 * static_cast<double>(world.ticks() % 3000);
        const double x = -0.027 + 0.012 * std::abs(phase - 3.0);
        ASSERT_FALSE(world.set_hand(0, hand_at(x, phase < 3.0 ? -0.024 : 0.024)));
        world.tick();
    }
}

class EveryProfile : public ::testing::TestWithParam<StepperKind> {
protected:
    [[nodiscard]] static World world()
    {
        const bool slides = GetParam() <= StepperKind::lone;
        FreezeOptions options;
        options.stepper = GetParam();
        return World::freeze(slides ? paper_scene() : row_of_cubes(), options).value();
    }
};

TEST_P(EveryProfile, ASnapshotBringsBackTheSameFuture)
{
    World world = this->world();
    play(world, 500);
    const World::Snapshot snapshot = world.snapshot();
    play(world, 700);
    const auto future = world.hash();
    world.restore(snapshot);
    play(world, 700);
    EXPECT_EQ(world.hash(), future);

    World other = this->world();
    other.restore(snapshot);
    play(other, 700);
    EXPECT_EQ(other.hash(), future);
}

TEST_P(EveryProfile, AWorldGoesToWhereAnotherOneIs)
{
    World world = this->world();
    play(world, 500);
    World other = this->world();
    play(other, 123);
    other.restore(world);
    EXPECT_EQ(other.hash(), world.hash());
    play(world, 700);
    play(other, 700);
    EXPECT_EQ(other.hash(), world.hash());
}

TEST_P(EveryProfile, ACopyRunsOnItsOwn)
{
    World world = this->world();
    play(world, 300);
    World copy = world;
    const auto before = world.hash();
    play(copy, 300);
    EXPECT_EQ(world.hash(), before);
    play(world, 300);
    EXPECT_EQ(world.hash(), copy.hash());
}

TEST_P(EveryProfile, AShiftedBodyIsHeldAsBeforeAndAPlacedOneIsTakenAnew)
{
    World shifted = this->world();
    HandInput grip = hand_at(-0.022);
    grip.gripping = true;
    shifted.set_hand(0, grip);
    shifted.tick();
    ASSERT_TRUE(shifted.touch(0).holding);
    World placed = shifted;
    const base::Displacement way{{1e-3, 0.0, 0.0}};
    const base::Position there = shifted.position(0) + way;
    EXPECT_EQ(shifted.shift(0, way), std::nullopt);
    EXPECT_EQ(placed.place(0, there, placed.velocity(0)), std::nullopt);
    EXPECT_EQ(shifted.position(0), there);
    shifted.tick();
    placed.tick();
    EXPECT_LT(shifted.touch(0).on_body.x(), -0.2); // 500 N/m pull it back by a millimetre
    EXPECT_NEAR(placed.touch(0).on_body.x(), 0.0, 0.05);

    const auto before = shifted.hash();
    expect_refused(shifted, Refusal::not_finite, shifted.shift(0, {{nan, 0.0, 0.0}}));
    expect_refused(shifted, Refusal::out_of_range, shifted.shift(0, {{1e9, 0.0, 0.0}}));
    expect_refused(shifted, Refusal::no_such_body, shifted.shift(99, way));
    EXPECT_EQ(shifted.hash(), before);
}

TEST(World, ShiftsABodyAndTurnsItAboutItsCentreAsFarAsItCanTurn)
{
    for (const Turning turning : {Turning::free, Turning::about_y, Turning::locked}) {
        Description scene = paper_scene();
        scene.bodies[0].turning = turning;
        World world = World::freeze(scene).value();
        const base::Position there = world.position(0) + base::Displacement{{1e-3, 0.0, 0.0}};
        EXPECT_EQ(world.shift(0, {{1e-3, 0.0, 0.0}}, {0.1, 0.2, 0.0}), std::nullopt);
        EXPECT_EQ(world.position(0), there);
        const glm::dquat turned = world.body(0).orientation;
        EXPECT_NEAR(turned.x, turning == Turning::free ? 0.05 : 0.0, 5e-4);
        EXPECT_NEAR(turned.y, turning == Turning::locked ? 0.0 : 0.1, 5e-4);
        EXPECT_EQ(turned.z, 0.0);
        const auto before = world.hash();
        expect_refused(world, Refusal::not_finite, world.shift(0, {}, {nan, 0.0, 0.0}));
        expect_refused(world, Refusal::out_of_range, world.shift(0, {}, {7.0, 0.0, 0.0}));
        expect_refused(world, Refusal::out_of_range,
                       world.shift(0, {{1e9, 0.0, 0.0}}, {0.0, 0.1, 0.0}));
        EXPECT_EQ(world.hash(), before);
    }
}

INSTANTIATE_TEST_SUITE_P(World, EveryProfile,
                         ::testing::Values(StepperKind::sliding, StepperKind::sliding_coulomb,
                                           StepperKind::lone, StepperKind::few, StepperKind::many),
                         [](const auto& each) {
                             std::string name{name_of(each.param)};
                             std::erase(name, '-');
                             return name;
                         });

} // namespace
} // namespace hapnet::scene::world_test
