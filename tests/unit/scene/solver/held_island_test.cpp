// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/solver/held_island.hpp"

#include "scene/solver/contact_solver.hpp"
#include "scene/solver/envelope_ldl.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <tuple>
#include <vector>

namespace hapnet::scene {

namespace {

TEST(EnvelopeLdl, SolvesWithinTheEnvelopeAndLeavesOutWhatDepends)
{
    // Rows 0, 1, 2 and 3, of which 2 begins at column 1 and 3 is the sum of 1 and 2.
    const std::array<std::array<double, 4>, 4> matrix{
        {{4.0, 1.0, 0.0, 1.0}, {1.0, 3.0, 1.0, 4.0}, {0.0, 1.0, 2.0, 3.0}, {1.0, 4.0, 3.0, 7.0}}};
    EnvelopeLdl factors{4, 6};
    for (const std::uint32_t first : {0U, 0U, 1U, 0U}) factors.add_row(first);
    factors.begin();
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = factors.first(i); j < i; ++j)
            factors.row(i)[j - factors.first(i)] = matrix[i][j];
        factors.factor(i, matrix[i][i]);
    }
    EXPECT_FALSE(factors.is_left_out(2));
    EXPECT_TRUE(factors.is_left_out(3));
    const std::array<double, 4> right{6.0, 10.0, 8.0, 18.0};
    std::array<double, 4> x = right;
    factors.solve(x);
    EXPECT_EQ(x[3], 0.0);
    for (std::size_t i = 0; i < 4; ++i) {
        double sum = 0.0;
        for (std::size_t j = 0; j < 4; ++j) sum += matrix[i][j] * x[j];
        EXPECT_NEAR(sum, right[i], 1e-12) << i;
    }
}

constexpr double cube_side = 0.04, cube_mass = 0.1, fall = 9.81e-3;

/// Stacked cubes on the ground. Each falls at the same speed, rotates a little, and pushes the cube
/// below by `start` at each corner.
struct Stack {
    std::vector<ContactBlock> blocks;
    std::vector<BodyResponse> responses;
    std::vector<BodyMotion> motions;
    std::vector<std::uint32_t> island;

    explicit Stack(std::uint32_t cubes, double start = 1e-4)
        : blocks(cubes), responses(cubes + 1), motions(cubes + 1), island(cubes)
    {
        std::iota(island.begin(), island.end(), 0U);
        const double inertia = cube_mass * cube_side * cube_side / 6.0;
        for (std::uint32_t i = 1; i <= cubes; ++i) {
            responses[i] = {glm::dvec3{1.0 / cube_mass}, glm::dmat3{1.0 / inertia}};
            motions[i] = {{0.001 * i, -fall, 0.0}, {0.02, 0.0, -0.01 * i}, glm::dvec3{0.0}};
            ContactBlock& block = blocks[i - 1];
            block.a = i - 1;
            block.b = i;
            block.count = 4;
            block.friction = 10.0;
            block.torsion_arm = 0.01;
            block.normal = {0.0, 1.0, 0.0};
            block.tangent_1 = {0.0, 0.0, 1.0};
            block.tangent_2 = {1.0, 0.0, 0.0};
            block.arm_a = {0.0, 0.5 * cube_side, 0.0};
            block.arm_b = {0.0, -0.5 * cube_side, 0.0};
            block.along_1 = {-0.02, -0.02, 0.02, 0.02};
            block.along_2 = {-0.02, 0.02, -0.02, 0.02};
            block.impulse.normal = {start, start, start, start};
        }
    }
    HeldIsland::Task task() { return {blocks, island, responses, motions}; }

    /// The largest speed in the island after the changes of the answer.
    double left_after(std::span<const ContactImpulse> answer)
    {
        for (std::size_t i = 0; i < blocks.size(); ++i) {
            const ContactBlock& block = blocks[i];
            ContactVector change = contact_vector(block, answer[i]);
            const ContactVector before = contact_vector(block, block.impulse);
            for (std::size_t k = 0; k < change.size(); ++k) change[k] -= before[k];
            const Wrench push = wrench(block, change);
            apply(push, block.arm_b, responses[block.b], motions[block.b]);
            if (block.a != 0)
                apply({-push.impulse, -push.angular}, block.arm_a, responses[block.a],
                      motions[block.a]);
        }
        double most = 0.0;
        for (const BodyMotion& motion : motions)
            most = std::max(
                {most, glm::length(motion.velocity), cube_side * glm::length(motion.spin)});
        return most;
    }
};

TEST(HeldIsland, BringsAStackToRestAtOnce)
{
    for (const std::uint32_t cubes : {1U, 2U, 10U, 30U}) {
        constexpr double start = 1.0; // so that no corner has to pull
        Stack stack{cubes, start};
        HeldIsland held{cubes, cubes};
        ASSERT_TRUE(held.begin(stack.task()));
        ASSERT_TRUE(held.solve(stack.task())) << cubes;
        // Each cube carries those above it, in addition to its earlier push.
        double weight = 0.0;
        for (std::uint32_t i = cubes; i-- > 0;) {
            weight += cube_mass * fall;
            double sum = 0.0;
            for (const double impulse : held.impulses()[i].normal) sum += impulse;
            EXPECT_NEAR(sum, weight + 4.0 * start, 1e-12) << i << " of " << cubes;
        }
        EXPECT_LT(stack.left_after(held.impulses()), 1e-12) << cubes;
    }
}

TEST(HeldIsland, LeavesAloneWhatSlipsOpensOrIsTooLarge)
{
    HeldIsland held{40, 40};
    Stack slipping{3};
    slipping.blocks[1].friction = 1e-3;
    slipping.blocks[1].impulse.tangent_1 = 4.1e-7; // beyond its limit
    EXPECT_FALSE(held.begin(slipping.task()));
    Stack on_two_points{3};
    on_two_points.blocks[2].impulse.normal = {1e-4, 1e-4, 0.0, 0.0};
    EXPECT_FALSE(held.begin(on_two_points.task()));
    Stack too_large{33};
    EXPECT_FALSE(held.begin(too_large.task()));
    Stack without{3, 0.0};
    EXPECT_FALSE(held.begin(without.task()));
}

TEST(HeldIsland, HasNoAnswerWhereSomethingWouldHaveToPullOrSlip)
{
    HeldIsland held{3, 3};
    Stack pulling{3};
    pulling.motions[3].velocity.y = 1.0; // flies away
    ASSERT_TRUE(held.begin(pulling.task()));
    EXPECT_FALSE(held.solve(pulling.task()));
    for (const double friction :
         {0.3, 0.03}) { // its bottom takes 0.18, the others 0.22 of what presses
        Stack sliding{3};
        for (ContactBlock& block : sliding.blocks) block.friction = friction;
        ASSERT_TRUE(held.begin(sliding.task()));
        EXPECT_EQ(held.solve(sliding.task()), friction > 0.2) << friction;
    }
}

/// Two cubes on one that turns on the ground; one contact pushes with three points, the least
/// speeds are not zero, and one between them does not push.
TEST(HeldIsland, MeetsEveryTargetWhereSeveralMeet)
{
    constexpr double start = 1.0, least = -1e-3;
    Stack stack{4, start};
    stack.blocks[2].a = 1; // on the first cube, as the second one is
    stack.blocks[3].a = 3; // a contact of the third and the fourth that does not push
    stack.blocks[3].impulse = {};
    stack.blocks[1].impulse.normal[3] = 0.0;
    for (BodyMotion& motion : stack.motions) motion.spin.y = 0.03;
    for (ContactBlock& block : stack.blocks) block.speed_min = {least, least, least, least};
    HeldIsland held{4, 4};
    ASSERT_TRUE(held.begin(stack.task()));
    ASSERT_TRUE(held.solve(stack.task()));
    std::ignore = stack.left_after(held.impulses());
    for (const std::size_t i : {0U, 1U, 2U}) {
        const ContactBlock& block = stack.blocks[i];
        const ContactVector velocity =
            velocity_at(block, stack.motions[block.a], stack.motions[block.b]);
        for (std::size_t point = 0; point < 3; ++point)
            EXPECT_NEAR(block.normal_speed(velocity, point), least, 1e-12) << i;
        for (std::size_t k = 3; k < 6; ++k) EXPECT_NEAR(velocity[k], 0.0, 1e-12) << i;
    }
    EXPECT_EQ(held.impulses()[1].normal[3], 0.0);
    EXPECT_EQ(held.impulses()[3].normal[0], 0.0);
}

/// Six cubes on one: all rows meet in its body.
TEST(HeldIsland, LeavesAloneWhatWouldCostMoreThanSweeps)
{
    HeldIsland held{7, 7};
    for (const std::uint32_t cubes : {4U, 7U}) {
        Stack stack{cubes, 1.0};
        for (std::uint32_t i = 1; i < cubes; ++i) stack.blocks[i].a = 1;
        EXPECT_EQ(held.begin(stack.task()), cubes == 4U) << cubes;
    }
}

/// As part of the solver, it costs six sweeps, is checked, and needs room for that.
TEST(HeldIsland, TakesSixSweepsOfAnIslandThatHasThem)
{
    for (const std::uint32_t sweeps_max : {12U, 31U}) {
        constexpr std::uint32_t cubes = 10;
        const Stack stack{cubes};
        ContactSolver solver{cubes, cubes};
        solver.begin(cubes);
        for (std::uint32_t i = 1; i <= cubes; ++i) {
            solver.response(i) = stack.responses[i];
            solver.end_motion(i) = {{0.0, -fall, 0.0}, glm::dvec3{0.0}, glm::dvec3{0.0}};
            solver.add() = stack.blocks[i - 1];
        }
        const SolverOutcome outcome = solver.solve_velocities({1e-14, 1e-10, sweeps_max});
        if (sweeps_max == 31U) {
            EXPECT_EQ(outcome.sweeps, 11U); // two, six, and two to check
            EXPECT_LT(outcome.change, 1e-12);
            for (std::uint32_t i = 1; i <= cubes; ++i)
                EXPECT_LT(glm::length(solver.end_motion(i).velocity), 1e-12) << i;
        } else {
            EXPECT_EQ(outcome.sweeps, 11U); // ordinary sweeps, two at a time
            EXPECT_GT(outcome.change, 1e-10);
        }
    }
}

} // namespace

} // namespace hapnet::scene
