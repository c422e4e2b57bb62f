// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/governor/limits_text.hpp"

#include "device/falcon/kinematics.hpp"
#include "device/omni/geometry.hpp"

#include <gtest/gtest.h>

namespace hapnet::device {
namespace {

void expect_equal(const GovernorLimits& a, const GovernorLimits& b)
{
    EXPECT_EQ(a.force_max_n, b.force_max_n);
    EXPECT_EQ(a.slew_max_n_per_s, b.slew_max_n_per_s);
    EXPECT_EQ(a.fade_out, b.fade_out);
    EXPECT_EQ(a.stall_max, b.stall_max);
    EXPECT_EQ(a.force_continuous_n, b.force_continuous_n);
    EXPECT_EQ(a.speed_max_m_per_s, b.speed_max_m_per_s);
    EXPECT_EQ(a.axes_out, b.axes_out);
    EXPECT_EQ(a.workspace_min, b.workspace_min);
    EXPECT_EQ(a.workspace_max, b.workspace_max);
    ASSERT_EQ(a.joints.has_value(), b.joints.has_value());
    if (a.joints) {
        EXPECT_EQ(a.joints->torque_max_nm, b.joints->torque_max_nm);
        EXPECT_EQ(a.joints->jacobian, b.joints->jacobian);
    }
}

TEST(LimitsText, ReadsBackToTheSameBitsWhetherThereAreLimitsOrNone)
{
    expect_equal(parse_limits(print_limits({}), "limits").value(), {});
    GovernorLimits all;
    all.force_max_n = 1.0 / 3.0;
    all.force_continuous_n = 0.1 + 0.2;
    all.speed_max_m_per_s = 1.0;
    all.axes_out = 2;
    all.workspace_min = {{-1.0 / 7.0, -0.06, 0.0}};
    all.workspace_max = {{1e-9 / 3.0, 0.06, 0.07}};
    all.joints = JointLimits{omni::jacobian_at, omni::torque_max_nm};
    expect_equal(parse_limits(print_limits(all), "limits").value(), all);
    all.joints = JointLimits{falcon::jacobian, glm::dvec3{0.4096}};
    expect_equal(parse_limits(print_limits(all), "limits").value(), all);
}

TEST(LimitsText, NamesTheLineOfWhatItDoesNotKnow)
{
    const auto read = parse_limits("force_max = \"3N\"\nforce_min = \"1N\"\n", "limits");
    ASSERT_FALSE(read.has_value());
    EXPECT_TRUE(read.error().message.starts_with("limits:2:")) << read.error().message;
}

} // namespace
} // namespace hapnet::device
