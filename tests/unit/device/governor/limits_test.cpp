// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/governor/limits.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace hapnet::device {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

TEST(LimitsFor, TakesOfEachLimitTheStricter)
{
    Capabilities can{.force_max_n = 2.0, .force_continuous_n = 0.5};
    can.speed_max_m_per_s = 1.0;
    can.axes_out = 2;
    EXPECT_EQ(limits_for(can, {.force_max_n = 3.3}).force_max_n, 2.0);
    const GovernorLimits limits = limits_for(can, {.force_max_n = 0.3});
    EXPECT_EQ(limits.force_max_n, 0.3);
    EXPECT_EQ(limits.force_continuous_n, 0.5);
    EXPECT_EQ(limits.speed_max_m_per_s, 1.0);
    EXPECT_EQ(limits.axes_out, 2);
    EXPECT_EQ(limits.workspace_max, can.workspace_max);
    EXPECT_EQ(limits.slew_max_n_per_s, GovernorLimits{}.slew_max_n_per_s);
}

TEST(LimitsFor, TakesAQuarterOfThePeakForWhatADeviceDoesNotSayOfItsMotors)
{
    EXPECT_EQ(limits_for({.force_max_n = 8.0}, {}).force_continuous_n, 2.0);
}

TEST(LimitsFor, KnowsNoReachAlongAnAxisThatADeviceDoesNotMeasure)
{
    Capabilities flat{.force_max_n = 1.0};
    flat.axes_in = 2;
    EXPECT_EQ(limits_for(flat, {}).workspace_max.y(), flat.workspace_max.y());
    EXPECT_EQ(limits_for(flat, {}).workspace_max.z(), infinite);
    EXPECT_EQ(limits_for(flat, {}).workspace_min.z(), -infinite);
}

} // namespace
} // namespace hapnet::device
