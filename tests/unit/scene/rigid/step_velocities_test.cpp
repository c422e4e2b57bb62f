// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/unit/scene/rigid/scenes.hpp"

#include <gtest/gtest.h>

namespace hapnet::scene {

namespace {

BodyDescription tilted(BodyDescription body, double angle)
{
    body.orientation = {std::cos(0.5 * angle), 0.6 * std::sin(0.5 * angle), 0.0,
                        0.8 * std::sin(0.5 * angle)};
    return body;
}

// The light body does not bear in a tick the load of the last tick. The sweeps end before such
// forces have given way, and such forces would throw the heavy body up.
TEST(RigidVelocities, ForcesOfTheLastTickThatDoNotFitThrowNoHeavyBodyOffALightOne)
{
    std::uint64_t anew = 0;
    for (const double light : {0.001, 0.0005, 0.0001}) {
        for (const double height : {0.005, 0.02, 0.1, 0.5}) {
            for (const double tilt : {0.0, 0.02, 0.2}) {
                Description scene = platform();
                scene.bodies.push_back(cube_at({0.0, half, 0.0}, light));
                scene.bodies.push_back(
                    tilted(cube_at({0.003, 3.0 * half + height, 0.002}, 1.0), tilt));
                World world = world_of(scene);
                run(world, 600);
                EXPECT_EQ(world.state().interventions.islands_limited, 0U)
                    << light << " " << height << " " << tilt;
                anew += world.state().interventions.islands_anew;
            }
        }
    }
    EXPECT_GT(anew, 0U);
}

TEST(RigidVelocities, WhatStandsOrSlidesIsNeverSolvedAnew)
{
    World stack = world_of(stack_of(10));
    run(stack, 500);
    EXPECT_EQ(stack.state().interventions.islands_anew, 0U);
    Description scene = platform();
    scene.bodies.push_back(cube_at({0.0, half, 0.0}));
    scene.bodies[0].velocity = {{0.5, 0.0, 0.2}};
    World slide = world_of(scene);
    run(slide, 500);
    EXPECT_EQ(slide.state().interventions.islands_anew, 0U);
}

} // namespace

} // namespace hapnet::scene
