// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/solver/block_solver.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <tuple>

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

TEST(ContactBlock, AContactThatOpensFastDoesNotStickOnItsLastPoint)
{
    // From a cube that spins far above a plane. If points are removed one after the other, one
    // would pull, and with the last one friction seems to hold.
    ContactBlock block;
    block.count = 4;
    block.friction = 0.50267320756031642;
    block.torsion_arm = 0.014666776882874015;
    block.along_1 = {-0.0085303661684259062, -0.031588127842053212, 0.016837470551028216,
                     -0.029141345931098957};
    block.along_2 = {-0.0049690793084131235, -0.026334906269198634, 0.0024212980163552103,
                     0.028029159451849826};
    block.speed_min = {-37.813387647152346, -43.997242962022547, -45.321113597684345,
                       -40.135882963931287};
    block.impulse = {{0.0021515401892122283, 0.0, 0.0015225552872247961, 0.00024990452356297559},
                     -0.0014803400756115818,
                     0.0012500752137037515,
                     5.6296342679901173e-06};
    block.matrix = {{{22.496648936629455, -170.33682201411608, -663.03069475683844,
                      67.319459611267831, -17.294799321615773, 0.0},
                     {-170.33682201411608, 37500.0, 0.0, 0.0, 3807.4854684493571, 0.0},
                     {-663.03069475683844, 0.0, 37500.0, -3807.4854684493571, 0.0, 0.0},
                     {67.319459611267831, 0.0, -3807.4854684493571, 397.35893934365038,
                      3.0116944384717685, 170.33682201411608},
                     {-17.294799321615773, 3807.4854684493571, 0.0, 3.0116944384717685,
                      408.30814119047346, 663.03069475683844},
                     {0.0, 0.0, 0.0, 170.33682201411608, 663.03069475683844, 37500.0}}};
    block.has_matrix = true;
    const ContactVector free{125.75447676959843, 1564.932752676187,  -4175.4523997031847,
                             570.16078308800127, -51.75921744039838, -1581.853710580431};
    ContactVector velocity = times(block.matrix, contact_vector(block, block.impulse));
    for (std::size_t i = 0; i < velocity.size(); ++i) velocity[i] += free[i];
    std::ignore = solve(block, velocity, 0.0);
    for (const double impulse : block.impulse.normal) EXPECT_GE(impulse, 0.0);
    EXPECT_LE(std::hypot(block.impulse.tangent_1, block.impulse.tangent_2),
              block.friction * block.normal_sum() * (1.0 + 1e-12));
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
