// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/omni/encoders.hpp"
#include "device/omni/geometry.hpp"
#include "proto/base/random.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <gtest/gtest.h>

namespace hapnet::device::omni {
namespace {

/// Calls `check` for points all over the workspace of the data sheet, its faces included.
void everywhere(const std::function<void(const base::Position&)>& check)
{
    constexpr int steps = 10;
    for (int i = -steps; i <= steps; ++i) {
        for (int j = -steps; j <= steps; ++j) {
            for (int k = -steps; k <= steps; ++k) {
                check({half_workspace_m * glm::dvec3{i, j, k} / double{steps}});
            }
        }
    }
}

double largest(const glm::dmat3& m)
{
    double most = 0.0;
    for (const int column : {0, 1, 2}) {
        for (const int row : {0, 1, 2}) most = std::max(most, glm::abs(m[column][row]));
    }
    return most;
}

TEST(OmniGeometry, FindsTheAnglesOfEveryPlaceInTheWorkspaceWithinTheMechanismsRange)
{
    everywhere([](const base::Position& position) {
        const Joints joints = joints_of(position);
        // Rounding of a few additions of lengths below 0.3 m.
        ASSERT_LT(base::norm(position_of(joints) - position), 1e-15);
        ASSERT_TRUE(is_reachable(joints));
    });
}

TEST(OmniGeometry, UsesThoseAnglesOfTheWorkspaceThatWereWorkedOutByHand)
{
    glm::dvec3 least{10.0};
    glm::dvec3 most{-10.0};
    everywhere([&](const base::Position& position) {
        const glm::dvec3 q = joints_of(position).angles;
        const glm::dvec3 angles{q.x, q.y, q.z - q.y};
        least = glm::min(least, angles);
        most = glm::max(most, angles);
    });
    // To the two decimals of the data sheet.
    EXPECT_NEAR(least.x, -0.54, 0.005);
    EXPECT_NEAR(most.x, 0.54, 0.005);
    EXPECT_NEAR(least.y, 0.14, 0.005);
    EXPECT_NEAR(most.y, 1.29, 0.005);
    EXPECT_NEAR(least.z, -0.52, 0.005);
    EXPECT_NEAR(most.z, 0.57, 0.005);
}

TEST(OmniGeometry, HasTheJacobianThatDifferencesOfPositionsGive)
{
    everywhere([](const base::Position& position) {
        const Joints joints = joints_of(position);
        constexpr double step = 1e-5;
        glm::dmat3 differences{0.0};
        for (const int joint : {0, 1, 2}) {
            glm::dvec3 change{0.0};
            change[joint] = step;
            const auto moved =
                position_of({joints.angles + change}) - position_of({joints.angles - change});
            differences[joint] = moved.value / (2.0 * step);
        }
        // A sixth of the third derivative, below 0.3 m, times the step squared; and rounding.
        ASSERT_LT(largest(jacobian(joints) - differences), 3e-11);
        ASSERT_LT(largest(jacobian_at(position) - jacobian(joints)), 1e-14);
    });
}

TEST(OmniGeometry, DoesTheSameWorkAtTheJointsAsAtTheStylus)
{
    const auto chance = base::Seed{7}.stream("omni/work");
    std::uint64_t draw = 0;
    const auto vector = [&] {
        ++draw;
        return glm::dvec3{chance.uniform(draw, 0), chance.uniform(draw, 1),
                          chance.uniform(draw, 2)} *
                   2.0 -
               1.0;
    };
    everywhere([&](const base::Position& position) {
        const glm::dmat3 j = jacobian_at(position);
        const glm::dvec3 force = 3.3 * vector();
        const glm::dvec3 turning = 5.0 * vector();
        const double at_joints = glm::dot(glm::transpose(j) * force, turning);
        const double at_stylus = glm::dot(force, j * turning);
        ASSERT_NEAR(at_joints, at_stylus, 1e-14); // products of numbers of the order of 1
    });
}

TEST(OmniGeometry, MovesTheStylusByTheDataSheetsResolutionWithACount)
{
    glm::dvec2 waist{1.0, 0.0};   // least and most, mm
    glm::dvec2 coarser{1.0, 0.0}; // of the two directions in which shoulder and forearm move it
    everywhere([&](const base::Position& position) {
        const glm::dmat3 j = 1000.0 * radians_per_count * jacobian_at(position);
        const double step = glm::length(j[0]);
        waist = {std::min(waist.x, step), std::max(waist.y, step)};
        // One count of the shoulder or of the forearm moves it by the nominal 0.055 mm everywhere.
        ASSERT_NEAR(glm::length(j[1]), 0.05586, 1e-5);
        ASSERT_NEAR(glm::length(j[2]), 0.05586, 1e-5);
        // The waist moves it at right angles to the other two, which are at an angle to each other.
        ASSERT_NEAR(glm::dot(j[0], j[1]), 0.0, 1e-15);
        ASSERT_NEAR(glm::dot(j[0], j[2]), 0.0, 1e-15);
        const double between = glm::abs(glm::dot(j[1], j[2])) / (0.05586 * 0.05586);
        coarser = {std::min(coarser.x, 0.05586 * std::sqrt(1.0 - between)),
                   std::max(coarser.y, 0.05586 * std::sqrt(1.0 + between))};
    });
    // Singular values of the Jacobian, to a micrometre: 0.038 to 0.092 mm in all.
    EXPECT_NEAR(waist.x, 0.0559, 0.001);
    EXPECT_NEAR(waist.y, 0.0915, 0.001);
    EXPECT_NEAR(coarser.x, 0.038, 0.001);
    EXPECT_NEAR(coarser.y, 0.069, 0.001);
}

TEST(OmniGeometry, NeedsNoMoreTorqueThanStatedForItsPeakForce)
{
    glm::dvec3 most{0.0};
    everywhere([&](const base::Position& position) {
        const glm::dmat3 j = jacobian_at(position);
        for (const int joint : {0, 1, 2}) {
            most[joint] = std::max(most[joint], force_max_n * glm::length(j[joint]));
        }
    });
    EXPECT_NEAR(most.x, 0.72, 0.005); // at the far corners, beyond the motor's limit
    EXPECT_LE(most.y, torque_max_nm.y * (1.0 + 1e-12));
    EXPECT_LE(most.z, torque_max_nm.z * (1.0 + 1e-12));
}

TEST(OmniGeometry, IsFiniteForEveryFinitePosition)
{
    for (const double far : {0.0, 1e-300, 0.2, 1.0, 1e6, 1e150}) {
        for (const glm::dvec3& direction : {glm::dvec3{1, 0, 0}, glm::dvec3{0, -1, 0},
                                            glm::dvec3{0, 0, 1}, glm::dvec3{1, 1, 1}}) {
            const base::Position position{far * direction + glm::dvec3{0.0, height_m, -depth_m}};
            EXPECT_TRUE(base::is_finite(joints_of(position).angles));
            const glm::dmat3 j = jacobian_at(position);
            for (const int joint : {0, 1, 2}) EXPECT_TRUE(base::is_finite(j[joint])) << far;
        }
    }
}

TEST(OmniEncoders, CountTheAnglesBackToTheNearestCount)
{
    const Joints zero = zero_from({1234, -567, 89});
    everywhere([&](const base::Position& position) {
        const Joints joints = joints_of(position);
        const glm::dvec3 off = joints_at(counts_at(joints, zero), zero).angles - joints.angles;
        for (const int joint : {0, 1, 2}) {
            ASSERT_LE(glm::abs(off[joint]), radians_per_count / 2 * (1.0 + 1e-9));
        }
    });
}

} // namespace
} // namespace hapnet::device::omni
