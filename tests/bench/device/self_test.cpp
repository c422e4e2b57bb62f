// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/device/arm.hpp"
#include "tests/bench/device/overhead.hpp"
#include "tests/bench/device/turns.hpp"

#include <gtest/gtest.h>

namespace hapnet::bench {
namespace {

TEST(Turns, FeelTheCubeWithAndWithoutAGovernor)
{
    for (const Load load : {Load::contact, Load::governed}) {
        Turns turns{load};
        EXPECT_GT(base::norm(turns.felt()), 0.1);
        if (load == Load::governed) {
            EXPECT_EQ(turns.governor().state(), device::GovernorState::active);
        }
    }
}

TEST(Arm, HasTheJacobianOfItsOwnPositions)
{
    // The elbow is up: the upper arm's angle is above the forearm's.
    const glm::dvec3 angles{0.2, 0.9, -0.6};
    const glm::dmat3 jacobian = arm_jacobian(stylus_at(angles));
    for (const int joint : {0, 1, 2}) {
        constexpr double step = 1e-6;
        glm::dvec3 more = angles;
        glm::dvec3 less = angles;
        more[joint] += step;
        less[joint] -= step;
        const base::Displacement moved = stylus_at(more) - stylus_at(less);
        for (const int axis : {0, 1, 2}) {
            // A central difference is off by its step squared and by 1e-16 / step.
            EXPECT_NEAR(jacobian[joint][axis], moved.value[axis] / (2.0 * step), 1e-9)
                << joint << " " << axis;
        }
    }
}

TEST(Overhead, IsARowWithATargetAndABaseline)
{
    const auto rows = measure_overhead(1);
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0].metric, "p50_us");
    EXPECT_EQ(rows[0].target, 10.0);
    EXPECT_TRUE(rows[0].baseline_value);
    EXPECT_FALSE(rows[1].target);
}

} // namespace
} // namespace hapnet::bench
