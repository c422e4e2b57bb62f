// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/solver/contact_solver.hpp"

#include "scene/solver/anderson.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::scene {

namespace {

TEST(Anderson, FindsTheFixedPointOfALinearIterationInAsManyStepsAsItHasModes)
{
    // x -> A x + b with rates 0.999, 0.9 and -0.5: plain iteration takes 1e4 steps.
    const std::array<double, 3> rate{0.999, 0.9, -0.5};
    std::array<double, 3> x{};
    std::array<double, 3> out{};
    Anderson anderson{3};
    anderson.begin(3);
    for (int i = 0; i < 6; ++i) {
        for (std::size_t k = 0; k < 3; ++k) out[k] = rate[k] * x[k] + 1.0;
        std::ignore = anderson.mix(x, out, x);
    }
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(x[k] * (1.0 - rate[k]), 1.0, 1e-9);
    }
}

/// Two steps that differ by so little that its square is less than the smallest number.
TEST(Anderson, StaysFiniteWhereTwoStepsAreNearlyTheSame)
{
    for (const double little : {1e-150, 1e-155, 1e-158, 1e-160, 1e-300}) {
        Anderson anderson{1};
        anderson.begin(1);
        std::array<double, 1> next{};
        std::ignore = anderson.mix(std::array{0.0}, std::array{little}, next);
        std::ignore = anderson.mix(std::array{0.0}, std::array{2.0 * little}, next);
        EXPECT_TRUE(std::isfinite(next[0])) << little;
    }
}

TEST(ContactSolver, CarriesAThousandfoldMassInAFewSweeps)
{
    ContactSolver solver{2, 2};
    solver.begin(2);
    const std::array<double, 2> mass{0.1, 100.0};
    const double fall = 9.81e-3;
    for (SolverIndex i = 1; i <= 2; ++i) {
        solver.response(i).inverse_mass = glm::dvec3{1.0 / mass[i - 1]};
        solver.end_motion(i) = {{0.0, -fall, 0.0}, glm::dvec3{0.0}, glm::dvec3{0.0}};
        Manifold manifold;
        manifold.count = 1;
        manifold.points[0] = {};
        ContactBlock& block = solver.add();
        prepare(block, manifold, {glm::dvec3{0.0}, glm::dvec3{0.0}}, {});
        block.a = i - 1;
        block.b = i;
        block.friction = 0.0;
        block.centripetal_velocity = {};
        block.speed_min = {};
    }
    const SolverOutcome outcome = solver.solve_velocities({1e-12, 1e-9, 60});
    EXPECT_LE(outcome.sweeps, 11U);
    EXPECT_NEAR(solver.blocks()[0].normal_sum(), 100.1 * fall, 1e-9);
    EXPECT_NEAR(solver.blocks()[1].normal_sum(), 100.0 * fall, 1e-9);
}

} // namespace

} // namespace hapnet::scene
