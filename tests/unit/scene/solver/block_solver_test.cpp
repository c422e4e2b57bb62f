// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/solver/block_solver.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace hapnet::scene {

namespace {

constexpr double half = 0.02;
constexpr double mass = 0.1;

/// A cube on a floor: the floor's normal up, four corners.
struct CubeOnFloor {
    ContactBlock block;
    BodyResponse response;

    explicit CubeOnFloor(double friction)
    {
        Manifold manifold;
        manifold.count = 4;
        std::uint32_t i = 0;
        for (const double x : {-half, half}) {
            for (const double z : {-half, half}) {
                manifold.points[i].position = {x, 0.0, z};
                manifold.points[i].feature = i;
                ++i;
            }
        }
        prepare(block, manifold, {glm::dvec3{0.0}, glm::dvec3{0.0, half, 0.0}}, {});
        block.b = 1;
        block.friction = friction;
        response.inverse_mass = glm::dvec3{1.0 / mass};
        response.inverse_inertia = glm::dmat3{1.0 / (2.0 / 3.0 * mass * half * half)};
        build_matrix(block, {}, response);
    }

    BodyMotion solved(BodyMotion motion)
    {
        const ContactVector change = solve(block, velocity_at(block, {}, motion), 0.0);
        apply(wrench(block, change), block.arm_b, response, motion);
        return motion;
    }
};

TEST(ContactBlock, WhatSticksStandsStillAfterOneSolution)
{
    CubeOnFloor cube{1.0};
    const BodyMotion after = cube.solved({{0.1, -1.0, 0.05}, {0.4, -0.3, 0.2}, glm::dvec3{0.0}});
    EXPECT_LT(glm::dot(after.velocity, after.velocity), 1e-28);
    EXPECT_LT(glm::dot(after.spin, after.spin), 1e-24);
}

TEST(ContactBlock, FrictionOpposesTheSlipWithItsLimitInEveryDirection)
{
    for (int i = 0; i < 16; ++i) {
        const double angle = 0.1 + 0.39 * i;
        const glm::dvec3 along{std::cos(angle), 0.0, std::sin(angle)};
        CubeOnFloor cube{0.3};
        const BodyMotion after =
            cube.solved({along + glm::dvec3{0.0, -0.5, 0.0}, glm::dvec3{0.0}, glm::dvec3{0.0}});
        const glm::dvec3 want = (1.0 - 0.3 * 0.5) * along;
        EXPECT_LT(glm::length(after.velocity - want), 1e-13) << angle;
        EXPECT_LT(glm::length(after.spin), 1e-11) << angle;
    }
}

TEST(ContactBlock, ImprovedAgainAndAgainItComesToTheSameSolution)
{
    const BodyMotion before{{0.8, -0.5, 0.3}, {0.0, 4.0, 0.0}, glm::dvec3{0.0}};
    CubeOnFloor full{0.3};
    const BodyMotion want = full.solved(before);
    CubeOnFloor cube{0.3};
    BodyMotion after = before;
    for (int i = 0; i < 40; ++i) {
        const ContactVector change = iterate(cube.block, velocity_at(cube.block, {}, after), 0.0);
        apply(wrench(cube.block, change), cube.block.arm_b, cube.response, after);
    }
    EXPECT_LT(glm::length(after.velocity - want.velocity), 1e-6);
    EXPECT_LT(glm::length(after.spin - want.spin), 1e-4);
}

TEST(ContactBlock, NothingPullsAndAnImpulseOnOneSideTipsTheCube)
{
    CubeOnFloor cube{0.0};
    const BodyMotion after = cube.solved({glm::dvec3{0.0}, {0.0, 0.0, 30.0}, glm::dvec3{0.0}});
    for (const double impulse : cube.block.impulse.normal) EXPECT_GE(impulse, 0.0);
    // The corners at -x go down and are held: the cube's spin about z lifts it.
    EXPECT_NEAR(after.velocity.y - half * after.spin.z, 0.0, 1e-15);
    EXPECT_GT(after.spin.z, 0.0);
}

TEST(ContactBlock, ALockedBodyIsNoTroubleForTheSolution)
{
    CubeOnFloor cube{0.5};
    cube.response.inverse_inertia = glm::dmat3{0.0};
    cube.response.inverse_mass.x = 0.0;
    build_matrix(cube.block, {}, cube.response);
    const BodyMotion after = cube.solved({{0.0, -1.0, 0.1}, glm::dvec3{0.0}, glm::dvec3{0.0}});
    EXPECT_LT(glm::length(after.velocity), 1e-15);
}

TEST(ContactMemory, AHitIsNotCarriedIntoTheNextTick)
{
    CubeOnFloor cube{0.0};
    std::ignore = cube.solved({{0.0, -1.0, 0.0}, glm::dvec3{0.0}, glm::dvec3{0.0}});
    ContactMemory memory;
    store_impulses(cube.block, 0.01, memory);
    double sum = 0.0;
    for (const double impulse : memory.normal_impulse) sum += impulse;
    EXPECT_NEAR(sum, 0.01, 1e-15);
}

} // namespace

} // namespace hapnet::scene
