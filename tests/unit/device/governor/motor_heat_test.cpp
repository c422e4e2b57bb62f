// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/governor/motor_heat.hpp"
#include "tests/support/device/governed.hpp"

#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace hapnet::device {
namespace {

using namespace std::chrono_literals;
using test::along_x;

TEST(MotorHeat, GoesTowardsTheSquareOfTheForceWithItsTime)
{
    MotorHeat heat{0.88, 15s};
    const base::Force force = along_x(0.88);
    for (int ms = 0; ms < 15'000; ++ms) heat.pass(force, 1ms);
    // 1 - 1/e, within the error of steps of 1 ms: less than 0.001 / 15 of it.
    EXPECT_NEAR(heat.heat(), 1.0 - std::exp(-1.0), 1e-4);
    EXPECT_EQ(heat.force_max_n(3.3), 3.3);
}

TEST(MotorHeat, IsNoneForMotorsThatBearAnything)
{
    MotorHeat heat{std::numeric_limits<double>::infinity(), 15s};
    heat.pass(along_x(100.0), 1h);
    EXPECT_EQ(heat.heat(), 0.0);
    EXPECT_EQ(heat.force_max_n(3.3), 3.3);
}

} // namespace
} // namespace hapnet::device
