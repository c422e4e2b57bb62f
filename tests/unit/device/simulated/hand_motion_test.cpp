// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/hand_motion.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::device {
namespace {

constexpr HandImpedance nominal{};
constexpr double friction_n = 0.26;

HandMotion motion(const HandImpedance& hand, double friction, double step_s)
{
    HandMotion result{hand, friction};
    result.set_step(step_s);
    return result;
}

/// Integrates in many short steps of symplectic Euler with Karnopp's friction: exact to about half
/// of a short step's path.
HandAxis in_short_steps(HandAxis axis, const HandDrive& drive, double seconds)
{
    constexpr int steps = 1000;
    const double dt = seconds / steps;
    for (int i = 0; i < steps; ++i) {
        const double target = drive.target_m + drive.target_velocity_m_per_s * (i + 0.5) * dt;
        const double pull = drive.force_n - nominal.damping_ns_per_m * axis.velocity_m_per_s -
                            nominal.stiffness_n_per_m * (axis.position_m - target);
        const double free = axis.velocity_m_per_s + dt * pull / nominal.mass_kg;
        const double lost = dt * friction_n / nominal.mass_kg;
        axis.velocity_m_per_s = std::abs(free) <= lost ? 0.0 : free - std::copysign(lost, free);
        axis.position_m += dt * axis.velocity_m_per_s;
    }
    return axis;
}

TEST(HandMotion, IsTheTextbooksOscillatorBelowTheCriticalDamping)
{
    const double rate = 5.0 / 0.4;
    const double turn = std::sqrt(1000.0 - rate * rate);
    for (const double t : {1e-6, 1e-3, 0.1}) {
        HandAxis axis{.position_m = 0.01};
        motion(nominal, 0.0, t).advance(axis, {});
        const double expected =
            0.01 * std::exp(-rate * t) * (std::cos(turn * t) + rate / turn * std::sin(turn * t));
        EXPECT_NEAR(axis.position_m, expected, 1e-16) << t;
    }
}

TEST(HandMotion, IsTheTextbooksAtAndAboveTheCriticalDamping)
{
    for (const double t : {1e-3, 0.1}) {
        HandAxis critical{.position_m = 0.01};
        motion({0.25, 10.0, 100.0}, 0.0, t).advance(critical, {});
        EXPECT_NEAR(critical.position_m, 0.01 * (1.0 + 20.0 * t) * std::exp(-20.0 * t), 1e-16);

        HandAxis heavy{.position_m = 0.01}; // roots -10 and -90 per second
        motion({0.1, 10.0, 90.0}, 0.0, t).advance(heavy, {});
        const double expected = 0.01 * (9.0 * std::exp(-10.0 * t) - std::exp(-90.0 * t)) / 8.0;
        EXPECT_NEAR(heavy.position_m, expected, 1e-16);
    }
}

TEST(HandMotion, FollowsATargetThatMovesEvenlyWithTheLagOfItsDamping)
{
    HandAxis axis;
    const HandMotion hand = motion(nominal, 0.0, 1e-3);
    for (int ms = 0; ms < 2000; ++ms) hand.advance(axis, {0.0, 1e-4 * ms, 0.1});
    EXPECT_NEAR(axis.position_m, 0.2 - 0.1 * 5.0 / 200.0, 1e-12);
    EXPECT_NEAR(axis.velocity_m_per_s, 0.1, 1e-12);
}

TEST(HandMotion, IsTheSameInOneStepAsInTwo)
{
    const HandDrive drive{1.0, 0.002, 0.05};
    HandAxis once{.position_m = 0.001, .velocity_m_per_s = 0.1};
    HandAxis twice = once;
    motion(nominal, friction_n, 2e-3).advance(once, drive);
    const HandMotion half = motion(nominal, friction_n, 1e-3);
    half.advance(twice, drive);
    half.advance(twice, {drive.force_n, drive.target_m + 1e-3 * 0.05, 0.05});
    EXPECT_NEAR(once.position_m, twice.position_m, 1e-17);
    EXPECT_NEAR(once.velocity_m_per_s, twice.velocity_m_per_s, 1e-14);
}

TEST(HandMotion, SticksWhileThePullIsWeakerThanTheFriction)
{
    const HandMotion hand = motion(nominal, friction_n, 1e-3);
    HandAxis axis;
    hand.advance(axis, {0.2599, 0.0, 0.0});
    EXPECT_EQ(axis.position_m, 0.0);
    hand.advance(axis, {0.2601, 0.0, 0.0});
    EXPECT_NEAR(axis.velocity_m_per_s, 1e-3 * 0.0001 / nominal.mass_kg, 1e-8);
}

TEST(HandMotion, BreaksAwayAtTheMomentAtWhichTheTargetPullsHarderThanTheFriction)
{
    // 0.2 N at the start and 40 N/s more: free after 1.5 ms of 2 ms.
    const HandDrive drive{0.2, 0.0, 0.2};
    HandAxis axis;
    motion(nominal, friction_n, 2e-3).advance(axis, drive);
    EXPECT_NEAR(axis.velocity_m_per_s, 0.5 * 40.0 / 0.2 * 0.5e-3 * 0.5e-3, 2e-7);
    HandAxis held;
    motion(nominal, friction_n, 1.5e-3).advance(held, drive);
    EXPECT_EQ(held.velocity_m_per_s, 0.0);
}

TEST(HandMotion, EndsWithinAStepAndStaysOrTurnsRound)
{
    struct Case {
        double force_n, velocity;
        bool stays;
    };
    for (const Case& c : {Case{0.0, 1e-3, true}, Case{-0.2, 1e-3, true}, Case{-1.0, 2e-3, false},
                          Case{2.0, -4e-3, false}, Case{-3.3, 16e-3, false}}) {
        HandAxis axis{.velocity_m_per_s = c.velocity};
        const HandAxis expected = in_short_steps(axis, {c.force_n, 0.0, 0.0}, 1e-3);
        motion(nominal, friction_n, 1e-3).advance(axis, {c.force_n, 0.0, 0.0});
        EXPECT_EQ(axis.velocity_m_per_s == 0.0, c.stays) << c.force_n;
        // A short step is 1 us: 16 nm at the fastest of these.
        EXPECT_NEAR(axis.position_m, expected.position_m, 16e-9) << c.force_n;
        EXPECT_NEAR(axis.velocity_m_per_s, expected.velocity_m_per_s, 2e-5) << c.force_n;
    }
}

TEST(HandMotion, AgreesWithShortStepsOverSecondsOfPushesAndRests)
{
    const HandMotion hand = motion(nominal, friction_n, 1e-3);
    HandAxis axis;
    HandAxis reference;
    for (int ms = 0; ms < 2000; ++ms) {
        const double t = 1e-3 * ms;
        const HandDrive drive{0.8 * std::sin(9.0 * t) + 0.5 * std::sin(70.0 * t),
                              0.01 * std::sin(3.0 * t), 0.03 * std::cos(3.0 * t)};
        hand.advance(axis, drive);
        reference = in_short_steps(reference, drive, 1e-3);
        // The error of the reference: some short steps of 0.2 m/s.
        ASSERT_NEAR(axis.position_m, reference.position_m, 1e-6) << ms;
    }
}

} // namespace
} // namespace hapnet::device
