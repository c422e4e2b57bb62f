// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/falcon/kinematics.hpp"

#include "proto/base/random.hpp"

#include <cmath>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

namespace hapnet::device::falcon {
namespace {

constexpr int steps = 9; // along each edge of the workspace

template <typename Visit>
void visit_workspace(Visit visit)
{
    const auto at = [](int i) { return reach_m * (2.0 * i / (steps - 1) - 1.0); };
    for (int x = 0; x < steps; ++x) {
        for (int y = 0; y < steps; ++y) {
            for (int z = 0; z < steps; ++z) visit(base::Position{{at(x), at(y), at(z)}});
        }
    }
}

double largest(const glm::dvec3& v)
{
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

TEST(FalconKinematics, ReachesTheWholeWorkspaceByTheAnglesThatItStates)
{
    visit_workspace([](const base::Position& grip) {
        const auto angles = inverse(grip);
        ASSERT_TRUE(angles);
        for (int leg = 0; leg < 3; ++leg) {
            EXPECT_GE((*angles)[leg], -57.0 / 57.29577951);
            EXPECT_LE((*angles)[leg], 92.0 / 57.29577951);
        }
    });
}

TEST(FalconKinematics, ForwardUndoesInverseFromAnywhereNear)
{
    visit_workspace([](const base::Position& grip) {
        const auto angles = inverse(grip);
        ASSERT_TRUE(angles);
        const base::Position beside{{0.9 * grip.x(), 0.9 * grip.y() + 0.004, 0.9 * grip.z()}};
        for (const base::Position& start : {base::Position{}, beside}) {
            const auto back = forward(*angles, start);
            ASSERT_TRUE(back) << grip.x() << ' ' << grip.y() << ' ' << grip.z();
            // Newton's last step is below 1e-11 m, and what is left after it far less.
            EXPECT_LT(largest((*back - grip).value), 1e-10);
        }
    });
}

TEST(FalconKinematics, JacobianIsTheSlopeOfForward)
{
    visit_workspace([](const base::Position& grip) {
        const Angles angles = inverse(grip).value();
        const glm::dmat3 slope = jacobian(grip);
        for (int leg = 0; leg < 3; ++leg) {
            constexpr double h = 1e-5;
            Angles more = angles;
            Angles less = angles;
            more[leg] += h;
            less[leg] -= h;
            const auto up = forward(more, grip);
            const auto down = forward(less, grip);
            ASSERT_TRUE(up && down);
            // Central differences are off by h^2 of the third derivative, here at most some 1e3 m.
            EXPECT_LT(largest((*up - *down).value / (2.0 * h) - slope[leg]), 1e-6);
        }
    });
}

TEST(FalconKinematics, MotorsDoTheWorkThatTheHandFeels)
{
    const base::RandomStream chance = base::Seed{7}.stream("falcon/work");
    std::uint64_t drawn = 0;
    visit_workspace([&](const base::Position& grip) {
        const auto draw = [&] { return 2.0 * chance.uniform(drawn++) - 1.0; };
        const glm::dvec3 force{draw(), draw(), draw()};
        const glm::dvec3 turn{1e-6 * draw(), 1e-6 * draw(), 1e-6 * draw()};
        const glm::dvec3 torque = glm::transpose(jacobian(grip)) * force;
        const Angles angles = inverse(grip).value();
        const auto moved = forward(angles + turn, grip);
        ASSERT_TRUE(moved);
        const glm::dvec3 path = (*moved - grip).value;
        const double at_hand = glm::dot(force, path);
        const double at_motors = glm::dot(torque, turn);
        // The path bends: off by the square of 1e-6 rad times the arm's curvature, and by what
        // Newton leaves.
        EXPECT_NEAR(at_hand, at_motors, 2e-11);
    });
}

TEST(FalconKinematics, HasNoPlaceForAnglesThatNoGripCanHave)
{
    EXPECT_FALSE(forward({-3.0, 3.0, 0.0}, {}));
    EXPECT_FALSE(forward({20.0, 20.0, 20.0}, {}));
    EXPECT_FALSE(forward({std::nan(""), 0.0, 0.0}, {}));
    EXPECT_FALSE(inverse({{0.5, 0.0, 0.0}}));
    EXPECT_FALSE(inverse({{std::nan(""), 0.0, 0.0}}));
    EXPECT_EQ(jacobian({{0.5, 0.0, 0.0}}), glm::dmat3{0.0});
}

TEST(FalconKinematics, CountsGoToAnglesAndBack)
{
    for (int count = -4000; count <= 4000; ++count) {
        const auto value = static_cast<std::int16_t>(count);
        const Counts counts{value, static_cast<std::int16_t>(-value), 17};
        ASSERT_EQ(encoders_at(angles_of(counts)), counts);
    }
    // 1280 counts turn the motor once, and the arm by 360 * 14.25 / 110 = 46.64 degrees.
    EXPECT_NEAR(angles_of({0, 1280, 0})[1] - angles_of({})[1], 0.8139581, 1e-7);
    EXPECT_NEAR(angles_of({})[0], 0.6108652, 1e-7);
}

TEST(FalconKinematics, ACountIsNoMoreThanItsResolutionAtTheMiddle)
{
    const glm::dmat3 slope = jacobian({});
    const double angle = angles_of({1, 0, 0})[0] - angles_of({})[0];
    for (int leg = 0; leg < 3; ++leg) {
        EXPECT_LT(angle * glm::length(slope[leg]), 0.00005) << glm::length(slope[leg]);
    }
}

} // namespace
} // namespace hapnet::device::falcon
