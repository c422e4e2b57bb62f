// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/governor/energy.hpp"

#include "tests/support/device/governed.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::device {
namespace {

using namespace std::chrono_literals;
using test::along_x;
using test::Governed;

constexpr double tiny = 1e-9;

/// Moves a hand evenly along x under a constant force.
void move(EnergyGuard& guard, double& x, double newtons, double metres_per_s, int ticks)
{
    for (int i = 0; i < ticks; ++i) {
        x += 1e-3 * metres_per_s;
        guard.pass(along_x(newtons), {{x, 0.0, 0.0}}, 1ms);
    }
}

EnergyGuard at_rest()
{
    EnergyGuard guard{{.power_max_w = 0.5, .work_max_j = 0.1}, 1ms};
    guard.pass({}, {}, 0ms);
    return guard;
}

TEST(EnergyGuard, CountsTheWorkIntoTheHandAndSubtractsTheHandsOwn)
{
    EnergyGuard guard = at_rest();
    double x = 0.0;
    move(guard, x, 2.0, 0.1, 100); // 2 N over 10 mm
    EXPECT_NEAR(guard.figures().net_j, 0.02, tiny);
    EXPECT_NEAR(guard.figures().power_max_w, 0.2, tiny);
    move(guard, x, 1.0, -0.1, 300);
    EXPECT_NEAR(guard.figures().net_j, -0.01, tiny);
    EXPECT_NEAR(guard.figures().net_max_j, 0.02, tiny);
    EXPECT_NEAR(guard.figures().work_5s_max_j, 0.02, tiny);
}

TEST(EnergyGuard, CountsTheWorkOfFiveSecondsAndForgetsWhatIsOlder)
{
    EnergyGuard guard = at_rest();
    double x = 0.0;
    move(guard, x, 0.1, 0.1, 20'000); // 10 mW
    EXPECT_NEAR(guard.figures().net_j, 0.2, tiny);
    EXPECT_GE(guard.figures().work_5s_max_j, 0.05 - tiny);
    EXPECT_LE(guard.figures().work_5s_max_j, 0.0506) << "up to one piece of 50 ms more";
}

TEST(EnergyGuard, DoesNotTakeAStepToAPlaceThatWasNotKnownForMotion)
{
    EnergyGuard guard = at_rest();
    guard.lose_place();
    guard.pass(along_x(3.0), {{0.1, 0.0, 0.0}}, 1ms);
    EXPECT_EQ(guard.figures().net_j, 0.0);
}

TEST(EnergyGuard, LeavesAForceThatBrakesTheHandAlone)
{
    EnergyGuard guard = at_rest();
    double x = 0.0;
    move(guard, x, 0.0, 1.0, 10);
    EXPECT_EQ(guard.allow(along_x(-3.3), {{1.0, 0.0, 0.0}}), along_x(-3.3));
}

TEST(EnergyGuard, TakesFromAPushOnlyWhatIsTooMuchAndOnlyAlongTheMotion)
{
    EnergyGuard guard = at_rest();
    double x = 0.0;
    move(guard, x, 0.0, 0.3, 10);
    const base::Velocity velocity{{0.3, 0.0, 0.0}};
    EXPECT_EQ(guard.allow(along_x(1.0), velocity), along_x(1.0)); // 0.3 W and 0.015 W more
    const base::Force left = guard.allow({{3.0, 1.0, 0.0}}, velocity);
    EXPECT_EQ(left.y(), 1.0);
    EXPECT_GT(left.x(), 1.0);
    // The velocity that the force itself adds until the next tick counts, too.
    const double mobility = EnergyGuard::behind_s / EnergyGuard::hand_kg;
    EXPECT_NEAR(0.3 * left.x() + mobility * (left.x() * left.x() + 1.0), 0.5, tiny);
}

TEST(EnergyGuard, KeepsTheMeanPowerOfAHandThatIsLighterThanItIsTakenFor)
{
    for (const double kg : {0.03, 0.1}) {
        EnergyGuard guard{{.power_max_w = 0.5, .work_max_j = 10.0}, 1ms};
        guard.pass({}, {}, 0ms);
        double x = 0.0, metres_per_s = 0.0;
        for (int tick = 0; tick < 200; ++tick) {
            const base::Force force = guard.allow(along_x(3.3), {}); // its device reports no motion
            metres_per_s += 1e-3 * force.x() / kg;
            x += 1e-3 * metres_per_s;
            guard.pass(force, {{x, 0.0, 0.0}}, 1ms);
        }
        EXPECT_GT(guard.figures().power_max_w, 0.4) << kg;
        EXPECT_LT(guard.figures().power_max_w, kg < 0.1 ? 0.58 : 0.53) << kg;
    }
}

TEST(EnergyGuard, GivesNothingOnceTheWorkIsUsedUpUntilItIsFiveSecondsOld)
{
    EnergyGuard guard = at_rest();
    double x = 0.0;
    move(guard, x, 1.0, 0.5, 200); // 0.1 J
    EXPECT_EQ(guard.allow(along_x(1.0), {}), base::Force{});
    EXPECT_EQ(guard.allow(along_x(-1.0), {{1.0, 0.0, 0.0}}), base::Force{});
    move(guard, x, 0.0, 0.0, 4000);
    EXPECT_EQ(guard.allow(along_x(1.0), {}), base::Force{});
    move(guard, x, 0.0, 0.0, 1100);
    EXPECT_EQ(guard.allow(along_x(1.0), {}), along_x(1.0));
}

TEST(EnergyGuard, SurvivesAGapOfHours)
{
    EnergyGuard guard = at_rest();
    double x = 0.0;
    move(guard, x, 1.0, 0.5, 200);
    guard.pass({}, {{x, 0.0, 0.0}}, 3h);
    EXPECT_EQ(guard.allow(along_x(1.0), {}), along_x(1.0));
}

TEST(GovernorOfEnergy, CountsTheTicksInWhichItTookSomethingAndObservesWhatItGave)
{
    Governed governed = Governed::ramped_in({.energy = EnergyLimits{0.5, 0.15}});
    double x = 0.0;
    double given_j = 0.0;
    for (int tick = 0; tick < 1000; ++tick) {
        x += 1e-3 * 0.4;
        governed.sample.hip = {{x, 0.0, 0.0}};
        governed.sample.velocity = {{0.4, 0.0, 0.0}};
        given_j += 1e-3 * 0.4 * governed.given.force().x();
        governed(along_x(3.0));
    }
    const EnergyFigures& figures = *governed.governor.energy();
    EXPECT_NEAR(figures.net_j, given_j, tiny);
    EXPECT_LE(figures.work_5s_max_j, 0.15 + tiny);
    EXPECT_GT(figures.work_5s_max_j, 0.14);
    EXPECT_LE(figures.power_max_w, 0.5);
    EXPECT_GT(governed.governor.counters().energy_limited, 900U);
}

TEST(GovernorOfEnergy, WithoutALimitObservesNothing)
{
    const Governed governed = Governed::ramped_in();
    EXPECT_EQ(governed.governor.energy(), nullptr);
}

} // namespace
} // namespace hapnet::device
