// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The governor's rules that come from the device: its axes, its reach, its joints, its motors.
#include "tests/support/device/governed.hpp"

#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace hapnet::device {
namespace {

using namespace std::chrono_literals;
using test::along_x;
using test::Governed;

constexpr double tiny = 1e-12; // N: the largest effect of rounding

GovernorLimits omni_limits()
{
    return limits_for({.force_max_n = 3.3, .force_continuous_n = 0.88}, {});
}

TEST(GovernorRules, GiveNoForceAlongAnAxisWithoutAMotor)
{
    Governed flat = Governed::ramped_in({.axes_out = 2});
    EXPECT_EQ(flat.play(10, {{0.3, 0.4, 5.0}}), (base::Force{{0.3, 0.4, 0.0}}));
    EXPECT_EQ(flat.governor.counters().flattened, 10U);
    EXPECT_EQ(flat.governor.counters().clamped, 0U);

    Governed blind = Governed::ramped_in({.axes_out = 0});
    EXPECT_EQ(blind.play(10, {{0.3, 0.4, 5.0}}), base::Force{});
    EXPECT_FALSE(blind.given.motors_on());
}

TEST(GovernorRules, GiveInsideTheWorkspaceAllOfAForce)
{
    Governed governed = Governed::ramped_in(limits_for({.force_max_n = 3.3}, {}));
    governed.sample.hip = {{0.08, -0.06, 0.0}}; // the border itself
    EXPECT_EQ(governed.play(5, {{0.5, -0.5, 0.0}}), (base::Force{{0.5, -0.5, 0.0}}));
    EXPECT_EQ(governed.governor.counters().outside, 0U);
}

TEST(GovernorRules, GiveOutsideTheWorkspaceOnlyWhatLeadsBackIn)
{
    Governed governed = Governed::ramped_in(limits_for({.force_max_n = 3.3}, {}));
    governed.sample.hip = {{0.08 + 0.005, -0.06 - 0.1, 0.0}};
    EXPECT_EQ(governed.play(5, {{0.5, -0.5, 0.5}}), (base::Force{{0.0, 0.0, 0.5}}));
    EXPECT_EQ(governed.governor.counters().outside, 5U);
    EXPECT_EQ(governed.play(5, {{-0.5, 0.5, 0.5}}), (base::Force{{-0.5, 0.5, 0.5}}));
    EXPECT_EQ(governed.governor.counters().outside, 5U);
}

TEST(GovernorRules, FadeWhatLeadsOutOverFiveMillimetresBeyondTheBorder)
{
    Governed governed = Governed::ramped_in(limits_for({.force_max_n = 3.3}, {}));
    for (const double share : {0.25, 0.5, 0.75}) {
        governed.sample.hip = {{-0.08 - share * 0.005, 0.0, 0.0}};
        EXPECT_NEAR(governed.play(5, along_x(-1.0)).x(), share - 1.0, tiny) << share;
    }
    EXPECT_GT(governed.play(5, along_x(-1.0)).x(), -1.0);
}

TEST(GovernorRules, CutWhatLeadsOutWhereAHandIsSuddenlyFarOutside)
{
    Governed governed = Governed::ramped_in(limits_for({.force_max_n = 3.3}, {}));
    EXPECT_NEAR(governed.play(5, along_x(3.0)).x(), 3.0, tiny);
    governed.sample.hip = {{0.2, 0.0, 0.0}};
    EXPECT_EQ(governed(along_x(3.0)), base::Force{}); // without a slew
}

/// An arm of 0.1 m and 0.2 m whose third joint moves nothing here.
glm::dmat3 two_arms(const base::Position& /*position*/)
{
    return {glm::dvec3{0.1, 0.0, 0.0}, glm::dvec3{0.0, 0.2, 0.0}, glm::dvec3{0.0}};
}

glm::dmat3 no_arm(const base::Position& /*position*/)
{
    return glm::dmat3{std::numeric_limits<double>::quiet_NaN()};
}

TEST(GovernorRules, ScaleAForceToWhatTheWeakestJointBears)
{
    GovernorLimits limits;
    limits.joints = JointLimits{{"test", two_arms}, glm::dvec3{0.05, 0.05, 0.05}};
    Governed governed = Governed::ramped_in(limits);
    EXPECT_EQ(governed.play(5, {{0.4, 0.2, 0.3}}), (base::Force{{0.4, 0.2, 0.3}}));
    EXPECT_EQ(governed.governor.counters().joint_limited, 0U);
    // 0.4 N at 0.2 m are 0.08 Nm: all of the force is scaled to five eighths.
    const base::Force force = governed.play(5, {{0.4, 0.4, 0.8}});
    EXPECT_NEAR(force.x(), 0.25, tiny);
    EXPECT_NEAR(force.y(), 0.25, tiny);
    EXPECT_NEAR(force.z(), 0.5, tiny);
    EXPECT_GE(governed.governor.counters().joint_limited, 4U);
}

TEST(GovernorRules, GiveNothingWhereAnArmCannotBe)
{
    GovernorLimits limits;
    limits.joints = JointLimits{{"test", no_arm}, glm::dvec3{1.0}};
    Governed governed = Governed::ramped_in(limits);
    EXPECT_EQ(governed.play(5, along_x(1.0)), base::Force{});
}

TEST(GovernorRules, LetThePeakPassForASecondAndGoDownToWhatTheMotorsBearWithoutAStep)
{
    Governed governed = Governed::ramped_in(omni_limits());
    EXPECT_NEAR(governed.play(1000, along_x(3.3)).x(), 3.3, tiny);
    EXPECT_EQ(governed.governor.counters().heat_limited, 0U);
    double before = 3.3;
    double steepest = 0.0;
    for (int ms = 0; ms < 60'000; ++ms) {
        const double now = governed(along_x(3.3)).x();
        steepest = std::max(steepest, before - now);
        before = now;
    }
    // (3.3 - 0.88) / 0.1 of limit per heat, of which 3.3 N bring 13.06 / 15 a second: 21 N/s.
    EXPECT_LT(steepest, 0.022);
    EXPECT_LE(before, 0.88 * std::sqrt(1.0 + MotorHeat::band));
    EXPECT_GT(before, 0.88);
    EXPECT_GT(governed.governor.counters().heat_limited, 59'000U);
    EXPECT_EQ(governed.governor.state(), GovernorState::active);
}

TEST(GovernorRules, GiveThePeakAgainWhenTheMotorsHaveCooledDown)
{
    Governed governed = Governed::ramped_in(omni_limits());
    governed.play(5000, along_x(3.3));
    EXPECT_LT(governed(along_x(3.3)).x(), 1.2);
    governed.play(15'000, {});
    EXPECT_NEAR(governed.play(5, along_x(3.3)).x(), 3.3, tiny);
}

TEST(GovernorRules, LetAForceGrowSlowlyAsLongAsItRampsIn)
{
    Governed governed;
    governed.play(501, {});
    EXPECT_NEAR(governed(along_x(3.0)).x(), 0.1, tiny);
    EXPECT_NEAR(governed(along_x(3.0)).x(), 0.2, tiny);
    EXPECT_NEAR(governed.play(8, along_x(3.0)).x(), 1.0, tiny);
    EXPECT_EQ(governed({}), base::Force{}); // but let go at once
    governed.play(600, {});
    EXPECT_NEAR(governed(along_x(3.0)).x(), 1.0, tiny);
}

TEST(GovernorRules, DoNotHideTheRampItself)
{
    Governed governed;
    for (int ms = 0; ms <= 1000; ++ms) {
        EXPECT_NEAR(governed(along_x(3.3)).x(), 3.3e-3 * ms, 1e-9) << ms;
    }
    EXPECT_EQ(governed.governor.counters().slewed, 0U);
}

} // namespace
} // namespace hapnet::device
