// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/maths/rotation.hpp"
#include "scene/rigid/free_flight.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::scene {
namespace {

/// A flight of the bodies of a description under gravity.
struct Flight {
    explicit Flight(const Description& description)
        : state{Bodies{description}}, flight{description, config, state}
    {
        state.pushes.resize(description.bodies.size());
        state.pushed = Bounded<BodyId>{description.bodies.size()};
    }
    void run(int ticks)
    {
        for (int i = 0; i < ticks; ++i) flight.step(config, state);
    }

    WorldConfig config{.gravity = {0.0, -9.81, 0.0}, .tick = 1e-3};
    WorldState state;
    FreeFlightStepper flight;
};

Description with(std::vector<BodyDescription> bodies)
{
    Description description;
    description.bodies = std::move(bodies);
    return description;
}

BodyDescription box(const glm::dvec3& half, const glm::dvec3& angular_velocity)
{
    BodyDescription body;
    body.half = half;
    body.velocity = {{0.3, 1.0, -0.2}};
    body.angular_velocity = angular_velocity;
    return body;
}

double distance(const glm::dvec3& a, const glm::dvec3& b)
{
    const glm::dvec3 d = a - b;
    return std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
}

TEST(Flight, IsAParabolaToThePicometreAfterASecond)
{
    Flight flight{with({box(glm::dvec3{0.02}, {1.0, 2.0, 3.0})})};
    flight.run(1000);
    EXPECT_LE(distance(flight.state.bodies.position.at(0), {0.3, 1.0 - 0.5 * 9.81, -0.2}), 1e-12);
    EXPECT_LE(distance(flight.state.bodies.velocity.at(0), {0.3, 1.0 - 9.81, -0.2}), 1e-12);
}

TEST(Flight, APushAcceleratesTheBodyByItsMassForTheTick)
{
    Flight flight{with({box(glm::dvec3{0.02}, {}), box(glm::dvec3{0.02}, {})})};
    flight.state.pushes[1] = {0.5, 0.0, -0.25};
    flight.state.pushed.add(1);
    flight.run(1);
    const Bodies& bodies = flight.state.bodies;
    const glm::dvec3 by = (bodies.velocity.at(1) - bodies.velocity.at(0));
    EXPECT_LE(distance(by, {5e-3, 0.0, -2.5e-3}), 1e-15);
    EXPECT_LE(distance(bodies.position.at(1) - bodies.position.at(0), 0.5e-3 * by), 1e-15);
}

TEST(Flight, ALockedAxisDoesNotFall)
{
    BodyDescription hovering = box(glm::dvec3{0.02}, {});
    hovering.locked.y = true;
    Flight flight{with({hovering})};
    flight.state.pushes[0] = {0.0, 1.0, 0.0};
    flight.state.pushed.add(0);
    flight.run(100);
    EXPECT_EQ(flight.state.bodies.position.y[0], 0.0);
    EXPECT_NEAR(flight.state.bodies.position.x[0], 0.03, 1e-15);
}

TEST(Flight, ACubeTurnsAboutItsAxisExactly)
{
    const glm::dvec3 spin{3.0, -2.0, 6.0};
    Flight flight{with({box(glm::dvec3{0.02}, spin)})};
    flight.run(1000);
    const glm::dquat expected = rotation_by(spin);
    const glm::dquat found = flight.state.bodies.orientation.at(0);
    EXPECT_NEAR(found.w, expected.w, 1e-13);
    EXPECT_NEAR(found.x, expected.x, 1e-13);
    EXPECT_NEAR(found.y, expected.y, 1e-13);
    EXPECT_NEAR(found.z, expected.z, 1e-13);
}

TEST(Flight, ACubeMayTurnManyTimesInATick)
{
    Flight flight{with({box(glm::dvec3{0.02}, {0.0, 1e4, 0.0}), box(glm::dvec3{0.02}, {})})};
    flight.run(10);
    EXPECT_NEAR(flight.state.bodies.orientation.y[0], std::sin(50.0), 1e-12);
    EXPECT_EQ(flight.state.bodies.orientation.w[1], 1.0);
}

TEST(Flight, ATiltedBoxTurnsExactlyAboutTheOnlyAxisThatIsFree)
{
    BodyDescription tilted = box({0.01, 0.02, 0.03}, {9.0, 2.0, 9.0});
    tilted.orientation = rotation_by({0.4, 0.0, 0.3});
    tilted.turning = Turning::about_y;
    Flight flight{with({tilted})};
    flight.run(500);
    const glm::dquat expected = rotation_by({0.0, 1.0, 0.0}) * tilted.orientation;
    EXPECT_NEAR(flight.state.bodies.orientation.w[0], expected.w, 1e-13);
    EXPECT_NEAR(flight.state.bodies.orientation.y[0], expected.y, 1e-13);
}

TEST(Flight, AngularMomentumStaysToTheLastBitAndOrientationsStayUnit)
{
    Flight flight{with({box({0.01, 0.02, 0.03}, {0.01, 10.0, 0.01})})};
    const glm::dvec3 before = flight.state.bodies.angular_momentum.at(0);
    flight.run(20000);
    EXPECT_EQ(flight.state.bodies.angular_momentum.at(0), before);
    const glm::dquat q = flight.state.bodies.orientation.at(0);
    EXPECT_NEAR(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z, 1.0, 1e-15);
}

TEST(Flight, BodiesOfEveryKindMoveSideBySideAsEachAlone)
{
    std::vector<BodyDescription> all;
    for (int i = 0; i < 300; ++i) {
        BodyDescription body = box(i % 7 == 3 ? glm::dvec3{0.01, 0.02, 0.03} : glm::dvec3{0.02},
                                   {1.0 * i, 2.0, i == 200 ? 5e3 : -1.0});
        if (i % 50 == 10) body.turning = Turning::locked;
        if (i % 60 == 20) body.turning = Turning::about_z;
        all.push_back(body);
    }
    Flight together{with(all)};
    together.run(5);
    for (const std::size_t i : {0U, 3U, 10U, 20U, 127U, 128U, 200U, 299U}) {
        Flight alone{with({all[i]})};
        alone.run(5);
        const Slot slot = static_cast<Slot>(i);
        EXPECT_EQ(together.state.bodies.orientation.at(slot), alone.state.bodies.orientation.at(0));
        EXPECT_EQ(together.state.bodies.position.at(slot), alone.state.bodies.position.at(0));
        Bodies& bodies = alone.state.bodies;
        const glm::dquat before = bodies.orientation.at(0);
        alone.run(1);
        const glm::dquat lanes = bodies.orientation.at(0);
        bodies.orientation.put(0, before);
        rotate_freely(bodies, 0, 1e-3);
        EXPECT_NEAR(bodies.orientation.at(0).w, lanes.w, 4e-16) << i;
        EXPECT_NEAR(bodies.orientation.at(0).z, lanes.z, 4e-16) << i;
    }
}

} // namespace
} // namespace hapnet::scene
