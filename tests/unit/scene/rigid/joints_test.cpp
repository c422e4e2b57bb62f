// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Joints against references: closed forms, and integrations with steps far below the tick. The
// errors are stated for the ticks that are run; what is of second order has to fall like that.
#include "scene/text/text.hpp"
#include "scene/world.hpp"
#include "tests/unit/scene/rigid/scenes.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <numbers>

namespace hapnet::scene {
namespace {

using namespace std::chrono_literals;

BodyDescription rod(const glm::dvec3& half, const glm::dvec3& centre, double mass_kg)
{
    BodyDescription body;
    body.half = half;
    body.position.value = centre;
    body.mass_kg = mass_kg;
    return body;
}

JointDescription hinge(std::uint32_t body, const glm::dvec3& at)
{
    JointDescription joint;
    joint.body = body;
    joint.position.value = at;
    joint.axis = {0.0, 0.0, 1.0};
    return joint;
}

Description without_hands()
{
    Description scene;
    scene.hands.count = 0;
    return scene;
}

/// Kinetic, of height, and of springs.
double whole_energy(const World& world, const Description& scene)
{
    double sum = 0.0;
    for (BodyId id = 0; id < scene.bodies.size(); ++id) {
        if (!scene.bodies[id].movable) continue;
        const BodyState body = world.body(id);
        const Slot slot = world.state().bodies.slot_of[id];
        const glm::dvec3 momentum = world.state().bodies.angular_momentum.at(slot);
        const double mass = scene.bodies[id].mass_kg;
        sum += 0.5 * (mass * glm::dot(body.velocity.value, body.velocity.value) +
                      glm::dot(momentum, body.angular_velocity)) -
               mass * glm::dot(scene.gravity, body.position.value);
    }
    for (JointId id = 0; id < scene.joints.size(); ++id) {
        const JointDescription& joint = scene.joints[id];
        const double slack = joint.kind == JointKind::spring
                                 ? glm::length(joint.position.value - joint.to_position.value)
                                 : 0.0;
        const double bend = world.joint(id).coordinate - joint.rest.value_or(slack);
        sum += 0.5 * joint.stiffness * bend * bend;
    }
    return sum;
}

/// How far the points of hinges and balls have come apart, m.
double apart(const World& world, const Description& scene)
{
    double most = 0.0;
    for (const JointDescription& joint : scene.joints) {
        if (joint.kind != JointKind::hinge && joint.kind != JointKind::ball) continue;
        const auto point = [&](std::optional<std::uint32_t> body) {
            if (!body) return joint.position.value;
            const BodyDescription& was = scene.bodies[*body];
            const BodyState now = world.body(*body);
            return now.position.value +
                   now.orientation * (glm::conjugate(was.orientation) *
                                      (joint.position.value - was.position.value));
        };
        most = std::max(most, glm::length(point(joint.body) - point(joint.to)));
    }
    return most;
}

Description pendulum()
{
    Description scene = without_hands();
    scene.bodies = {rod({0.1, 0.01, 0.02}, {0.1, 0.0, 0.0}, 0.2)};
    scene.joints = {hinge(0, glm::dvec3{0.0})};
    return scene;
}

/// The period of a swing from 90 degrees: by the arithmetic-geometric mean.
double exact_period()
{
    const double lever = 0.1;
    const double inertia = (0.1 * 0.1 + 0.01 * 0.01) / 3.0 + lever * lever; // of 1 kg
    double a = 1.0;
    double b = std::cos(std::numbers::pi / 4.0);
    for (int i = 0; i < 8; ++i) {
        const double mean = 0.5 * (a + b);
        b = std::sqrt(a * b);
        a = mean;
    }
    return 2.0 * std::numbers::pi * std::sqrt(inertia / (gravity * lever)) / a;
}

/// The mean of the first three, from one passage through the lowest point to the next.
double period(base::Duration tick)
{
    World world = world_of(pendulum(), tick);
    const double step = base::to_seconds(tick);
    std::array<double, 4> passed{};
    std::size_t found = 0;
    double last = world.joint(0).coordinate;
    const double lowest = -0.5 * std::numbers::pi;
    while (found < passed.size() && world.ticks() < 100'000) {
        world.tick();
        const double now = world.joint(0).coordinate;
        if (last > lowest && now <= lowest) {
            const double share = (last - lowest) / (last - now);
            passed[found++] = step * (static_cast<double>(world.ticks() - 1) + share);
        }
        last = now;
    }
    return (passed[3] - passed[0]) / 3.0;
}

TEST(Joints, APendulumHasThePeriodOfTheEllipticIntegralToTheSecondOrder)
{
    const double exact = exact_period();
    const double coarse = std::abs(period(4ms) / exact - 1.0);
    const double fine = std::abs(period(1ms) / exact - 1.0);
    EXPECT_LT(coarse, 1e-3);
    EXPECT_LT(fine, 4e-5);
    EXPECT_LT(fine, coarse / 12.0);
}

TEST(Joints, APendulumSwingsForAMinuteWithoutAGainAndHardlyALoss)
{
    const Description scene = pendulum();
    World world = world_of(scene);
    const double swing = 0.2 * gravity * 0.1; // J, from the top to the bottom
    for (int i = 0; i < 60'000; ++i) {
        world.tick();
        ASSERT_LT(whole_energy(world, scene), 1e-9 * swing) << i;
        ASSERT_LT(apart(world, scene), 1e-8) << i;
    }
    EXPECT_GT(whole_energy(world, scene), -1e-3 * swing);
    EXPECT_EQ(world.state().interventions.guards(), 0U);
}

TEST(Joints, ASliderOnASlopeFallsAsGravityAlongItSays)
{
    for (const double angle : {0.2, 0.7, 1.3}) {
        Description scene = without_hands();
        scene.bodies = {rod(glm::dvec3{0.02}, glm::dvec3{0.0}, 0.1)};
        JointDescription joint;
        joint.kind = JointKind::slider;
        joint.axis = {std::cos(angle), -std::sin(angle), 0.0};
        scene.joints = {joint};
        World world = world_of(scene);
        for (int i = 0; i < 1000; ++i) world.tick();
        const double way = 0.5 * gravity * std::sin(angle);
        EXPECT_NEAR(world.joint(0).coordinate, way, 1e-12);
        EXPECT_NEAR(glm::length(world.position(0).value - way * joint.axis), 0.0, 1e-12);
    }
}

Description hung(double stiffness, double damping)
{
    Description scene = without_hands();
    scene.bodies = {rod(glm::dvec3{0.02}, {0.0, -0.1, 0.0}, 0.1)};
    JointDescription joint;
    joint.kind = JointKind::spring;
    joint.position.value = {0.0, -0.1, 0.0};
    joint.stiffness = stiffness;
    joint.damping = damping;
    scene.joints = {joint};
    return scene;
}

/// How far the mass is from where the closed form has it, at most within a second, m.
double error_of_spring(double damping, base::Duration tick)
{
    const double stiffness = 100.0;
    const double mass = 0.1;
    World world = world_of(hung(stiffness, damping), tick);
    const double decay = 0.5 * damping / mass;
    const double turns = std::sqrt(stiffness / mass - decay * decay);
    const double rest = mass * gravity / stiffness;
    double most = 0.0;
    while (world.ticks() < static_cast<std::uint64_t>(1s / tick)) {
        world.tick();
        const double t = base::to_seconds(tick) * static_cast<double>(world.ticks());
        const double swing = std::cos(turns * t) + decay / turns * std::sin(turns * t);
        const double exact = 0.1 + rest * (1.0 - std::exp(-decay * t) * swing);
        most = std::max(most, std::abs(world.joint(0).coordinate - exact));
    }
    return most;
}

TEST(Joints, ASpringSwingsAndDecaysAsItsClosedFormDoesToTheSecondOrder)
{
    for (const double damping : {0.0, 1.0}) {
        const double coarse = error_of_spring(damping, 4ms);
        const double fine = error_of_spring(damping, 1ms);
        EXPECT_LT(fine, 3e-5) << damping;
        EXPECT_LT(fine, coarse / 12.0) << damping;
    }
}

TEST(Joints, ASpringNeverGainsHoweverStiff)
{
    for (const double stiffness : {1e2, 1e4, 1e6, 1e8}) {
        for (const double rest : {0.0, 0.09, 0.1}) {
            Description scene = hung(stiffness, 0.0);
            scene.joints[0].rest = rest;
            scene.bodies[0].velocity.value = {0.5, 0.0, 0.2};
            World world = world_of(scene);
            const double start = whole_energy(world, scene);
            const double there = std::abs(start) + 0.1;
            for (int i = 0; i < 5000; ++i) {
                world.tick();
                ASSERT_LT(whole_energy(world, scene) - start, 1e-9 * there)
                    << stiffness << ' ' << rest;
            }
        }
    }
}

TEST(Joints, TwoBodiesOnASpringKeepTheirMomenta)
{
    for (const double stiffness : {1e2, 1e8}) {
        Description scene = without_hands();
        scene.gravity = glm::dvec3{0.0};
        scene.bodies = {rod({0.02, 0.03, 0.01}, glm::dvec3{0.0}, 0.1),
                        rod(glm::dvec3{0.02}, {0.2, 0.0, 0.0}, 0.3)};
        scene.bodies[0].velocity.value = {0.0, 0.4, 0.1};
        scene.bodies[1].angular_velocity = {1.0, 2.0, 3.0};
        JointDescription joint;
        joint.kind = JointKind::spring;
        joint.body = 1;
        joint.to = 0;
        joint.position.value = {0.18, 0.02, 0.0};
        joint.to_position.value = {0.02, 0.0, 0.0};
        joint.stiffness = stiffness;
        scene.joints = {joint};
        World world = world_of(scene);
        const auto momentum = [&] {
            return 0.1 * world.velocity(0).value + 0.3 * world.velocity(1).value;
        };
        const glm::dvec3 start = momentum();
        for (int i = 0; i < 2000; ++i) world.tick();
        EXPECT_LT(glm::length(momentum() - start), 1e-12) << stiffness;
    }
}

Description double_pendulum()
{
    Description scene = without_hands();
    scene.bodies = {rod({0.1, 0.01, 0.02}, {0.1, 0.0, 0.0}, 0.2),
                    rod({0.1, 0.01, 0.02}, {0.3, 0.0, 0.0}, 0.1)};
    scene.joints = {hinge(0, glm::dvec3{0.0}), hinge(1, {0.2, 0.0, 0.0})};
    scene.joints[1].to = 0;
    return scene;
}

/// Angles and rates of both rods, from the horizontal.
using Angles = std::array<double, 4>;

/// Lagrange's equations of two rods.
Angles rates_of(const Angles& q)
{
    constexpr double m1 = 0.2, m2 = 0.1, reach = 0.2, lever = 0.1;
    constexpr double own = (0.1 * 0.1 + 0.01 * 0.01) / 3.0;
    const double cosine = std::cos(q[0] - q[1]);
    const double sine = std::sin(q[0] - q[1]);
    const double a = m1 * (own + lever * lever) + m2 * reach * reach;
    const double b = m2 * reach * lever * cosine;
    const double c = m2 * (own + lever * lever);
    const double f = -m2 * reach * lever * sine * q[3] * q[3] -
                     gravity * (m1 * lever + m2 * reach) * std::cos(q[0]);
    const double g =
        m2 * reach * lever * sine * q[2] * q[2] - gravity * m2 * lever * std::cos(q[1]);
    const double determinant = a * c - b * b;
    return {q[2], q[3], (c * f - b * g) / determinant, (a * g - b * f) / determinant};
}

/// The classical Runge-Kutta method, with steps of 10 us.
Angles angles_after(double seconds)
{
    constexpr double step = 1e-5;
    const auto moved = [](const Angles& q, const Angles& rate, double by) {
        Angles sum = q;
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += by * rate[i];
        return sum;
    };
    Angles q{};
    const auto steps = std::lround(seconds / step);
    for (long n = 0; n < steps; ++n) {
        const Angles k1 = rates_of(q);
        const Angles k2 = rates_of(moved(q, k1, 0.5 * step));
        const Angles k3 = rates_of(moved(q, k2, 0.5 * step));
        const Angles k4 = rates_of(moved(q, k3, step));
        for (std::size_t i = 0; i < q.size(); ++i)
            q[i] += step / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
    }
    return q;
}

double error_of_double_pendulum(base::Duration tick)
{
    World world = world_of(double_pendulum(), tick);
    while (world.ticks() < static_cast<std::uint64_t>(500ms / tick)) world.tick();
    const Angles exact = angles_after(0.5);
    return std::abs(world.joint(0).coordinate - exact[0]) +
           std::abs(world.joint(0).coordinate + world.joint(1).coordinate - exact[1]);
}

TEST(Joints, ADoublePendulumFollowsLagrangesEquationsToTheSecondOrder)
{
    const double coarse = error_of_double_pendulum(4ms);
    const double fine = error_of_double_pendulum(1ms);
    EXPECT_LT(fine, 1e-3);
    EXPECT_LT(fine, coarse / 10.0);
}

TEST(Joints, ADoorStopsAtItsLimitAndBouncesAsItsRestitutionSays)
{
    for (const double restitution : {0.0, 0.5}) {
        Description scene = without_hands();
        scene.gravity = glm::dvec3{0.0};
        scene.bodies = {rod({0.1, 0.01, 0.1}, {0.1, 0.0, 0.0}, 0.5)};
        scene.bodies[0].angular_velocity = {0.0, 0.0, 2.0};
        scene.bodies[0].velocity.value = {0.0, 0.2, 0.0};
        scene.joints = {hinge(0, glm::dvec3{0.0})};
        scene.joints[0].highest = 1.0;
        scene.joints[0].restitution = restitution;
        World world = world_of(scene);
        for (int i = 0; i < 600; ++i) {
            world.tick();
            ASSERT_LT(world.joint(0).coordinate, 1.0 + 1e-9);
        }
        EXPECT_NEAR(world.joint(0).rate, -2.0 * restitution, 1e-3);
        EXPECT_NEAR(world.body(0).angular_velocity.z, -2.0 * restitution, 1e-3);
    }
}

TEST(Joints, AFourBarLoopStaysClosed)
{
    Description scene = without_hands();
    scene.bodies = {rod({0.01, 0.05, 0.01}, {0.0, 0.05, 0.0}, 0.1),
                    rod({0.1, 0.01, 0.01}, {0.1, 0.1, 0.0}, 0.2),
                    rod({0.01, 0.05, 0.01}, {0.2, 0.05, 0.0}, 0.1)};
    scene.joints = {hinge(0, glm::dvec3{0.0}), hinge(1, {0.0, 0.1, 0.0}), hinge(2, {0.2, 0.1, 0.0}),
                    hinge(2, {0.2, 0.0, 0.0})};
    scene.joints[1].to = 0;
    scene.joints[2].to = 1;
    scene.bodies[0].velocity.value = {0.01, 0.0, 0.0};
    World world = world_of(scene);
    const double start = whole_energy(world, scene);
    for (int i = 0; i < 10'000; ++i) {
        world.tick();
        ASSERT_LT(apart(world, scene), 1e-7) << i;
        ASSERT_LT(whole_energy(world, scene) - start, 1e-9 * std::abs(start)) << i;
    }
    EXPECT_LT(world.position(1).y(), 0.2);
}

TEST(Joints, AChainOfTenCarriesAThousandTimesTheWeightOfALink)
{
    Description scene = without_hands();
    for (std::uint32_t i = 0; i < 10; ++i) {
        const double top = -0.04 * i;
        scene.bodies.push_back(
            rod({0.005, 0.02, 0.005}, {0.0, top - 0.02, 0.0}, i == 9 ? 10.0 : 0.01));
        scene.joints.push_back(hinge(i, {0.0, top, 0.0}));
        scene.joints.back().kind = JointKind::ball;
        if (i > 0) scene.joints.back().to = i - 1;
    }
    scene.bodies[9].velocity.value = {0.3, 0.0, 0.1};
    World world = world_of(scene);
    const double start = whole_energy(world, scene);
    for (int i = 0; i < 10'000; ++i) {
        world.tick();
        ASSERT_LT(apart(world, scene), 1e-5) << i;
        ASSERT_LT(whole_energy(world, scene) - start, 1e-9 * std::abs(start)) << i;
    }
    EXPECT_LT(world.position(9).y(), -0.36);
    EXPECT_EQ(world.state().interventions.guards(), 0U);
}

TEST(Joints, AJoinedBodyAtRestFallsAsleepAndWakesWithItsGroup)
{
    Description scene = without_hands();
    scene.bodies = {rod({0.005, 0.02, 0.005}, {0.0, -0.02, 0.0}, 0.1),
                    rod({0.005, 0.02, 0.005}, {0.0, -0.06, 0.0}, 0.1)};
    scene.joints = {hinge(0, glm::dvec3{0.0}), hinge(1, {0.0, -0.04, 0.0})};
    scene.joints[1].to = 0;
    auto world = World::freeze(scene);
    ASSERT_TRUE(world);
    for (int i = 0; i < 300; ++i) world->tick();
    EXPECT_FALSE(world->is_awake(0));
    EXPECT_FALSE(world->is_awake(1));
    ASSERT_FALSE(world->push(1, base::Force{{1.0, 0.0, 0.0}}));
    world->tick();
    EXPECT_TRUE(world->is_awake(0));
    EXPECT_TRUE(world->is_awake(1));
    EXPECT_NEAR(world->joint(0).force.y(), 0.2 * gravity, 0.1);
}

TEST(Joints, BodiesThatAreJoinedTouchEachOtherOnlyWhereTheJointSaysSo)
{
    for (const bool collides : {false, true}) {
        Description scene = without_hands();
        scene.gravity = glm::dvec3{0.0};
        scene.bodies = {rod(glm::dvec3{0.02}, glm::dvec3{0.0}, 0.1),
                        rod(glm::dvec3{0.02}, {0.1, 0.0, 0.0}, 0.1)};
        scene.bodies[1].velocity.value = {-1.0, 0.0, 0.0};
        JointDescription joint;
        joint.kind = JointKind::slider;
        joint.body = 1;
        joint.to = 0;
        joint.axis = {1.0, 0.0, 0.0};
        joint.collides = collides;
        scene.joints = {joint};
        World world = world_of(scene);
        for (int i = 0; i < 200; ++i) world.tick();
        EXPECT_EQ(world.position(1).x() > world.position(0).x(), collides);
    }
}

World built_in(const std::string& name)
{
    auto scene = load_scene(name, {});
    EXPECT_TRUE(scene) << scene.error().message;
    auto world = World::freeze(*scene);
    EXPECT_TRUE(world) << world.error().message;
    return *std::move(world);
}

TEST(Joints, AButtonGoesDownUnderAHandAndComesBack)
{
    World world = built_in("button");
    HandInput hand{.position = {{0.0, 0.0102, 0.0}}, .velocity = {{0.0, -0.02, 0.0}}};
    for (int i = 0; i < 1000; ++i) {
        ASSERT_FALSE(world.set_hand(0, hand));
        world.tick();
        hand.position.value.y -= 0.02e-3;
        ASSERT_GT(world.joint(0).coordinate, -0.008 - 1e-9);
    }
    EXPECT_NEAR(world.joint(0).coordinate, -0.008, 1e-6);
    EXPECT_GT(world.touch(0).on_hand.y(), 300.0 * 0.011); // the spring, and the stop
    hand.present = false;
    ASSERT_FALSE(world.set_hand(0, hand));
    for (int i = 0; i < 500; ++i) world.tick();
    EXPECT_NEAR(world.joint(0).coordinate, 0.0, 1e-6);
}

TEST(Joints, ADoorOpensUnderAHandAndCloses)
{
    World world = built_in("door");
    HandInput hand{.position = {{0.18, 0.0, 0.0145}}, .velocity = {{0.0, 0.0, -0.1}}};
    double widest = 0.0;
    for (int i = 0; i < 1000; ++i) {
        ASSERT_FALSE(world.set_hand(0, hand));
        world.tick();
        hand.position.value.z -= 0.1e-3;
        widest = std::max(widest, world.joint(0).coordinate);
    }
    EXPECT_GT(widest, 0.3);
    hand.present = false;
    ASSERT_FALSE(world.set_hand(0, hand));
    for (int i = 0; i < 4000; ++i) world.tick();
    EXPECT_NEAR(world.joint(0).coordinate, 0.0, 1e-6);
}

TEST(Joints, ADrawerComesBack)
{
    World world = built_in("drawer");
    ASSERT_FALSE(world.apply_impulse(1, {0.0, 0.0, 0.4}, world.position(1)));
    double farthest = 0.0;
    for (int i = 0; i < 4000; ++i) {
        world.tick();
        farthest = std::max(farthest, world.joint(0).coordinate);
    }
    EXPECT_GT(farthest, 0.05);
    EXPECT_LT(farthest, 0.15);
    EXPECT_NEAR(world.joint(0).coordinate, 0.0, 1e-6);
    EXPECT_NEAR(world.joint(1).coordinate, 0.1 + 0.1 * gravity / 50.0, 1e-4);
}

TEST(Joints, AJoinedBodyThatHitsAWallFastIsPutTogetherAgain)
{
    Description scene = without_hands();
    scene.gravity = glm::dvec3{0.0};
    scene.bodies = {rod(glm::dvec3{0.01}, glm::dvec3{0.0}, 0.1),
                    rod(glm::dvec3{0.01}, {0.05, 0.0, 0.0}, 0.1)};
    for (BodyDescription& body : scene.bodies) body.velocity.value = {60.0, 0.0, 0.0};
    scene.joints = {hinge(1, {0.025, 0.0, 0.0})};
    scene.joints[0].to = 0;
    BodyDescription wall = rod({0.02, 1.0, 1.0}, {1.0, 0.0, 0.0}, 1.0);
    wall.movable = false;
    scene.bodies.push_back(wall);
    World world = world_of(scene);
    const double start = whole_energy(world, scene);
    for (int i = 0; i < 200; ++i) {
        world.tick();
        ASSERT_LT(whole_energy(world, scene), start * (1.0 + 1e-9));
        ASSERT_LT(world.position(0).x(), 0.98);
        ASSERT_LT(world.position(1).x(), 0.98);
    }
    EXPECT_LT(apart(world, scene), 1e-6);
}

} // namespace
} // namespace hapnet::scene
