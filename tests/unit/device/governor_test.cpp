// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/device/governed.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <limits>

namespace hapnet::device {
namespace {

using namespace std::chrono_literals;

// A thousand additions of 0.001 and a product: far below a nanonewton.
constexpr double rounding = 1e-12;

using test::along_x;
using Ticks = test::Governed;

TEST(Governor, RampsInOverASecondFromThePermissionOn)
{
    Ticks ticks;
    EXPECT_EQ(ticks(along_x(1.0)), base::Force{}); // the first tick has no past
    for (int ms = 1; ms <= 1000; ++ms) {
        EXPECT_NEAR(ticks(along_x(1.0)).x(), 1e-3 * ms, rounding) << ms;
    }
    EXPECT_NEAR(ticks(along_x(1.0)).x(), 1.0, rounding);
}

TEST(Governor, FadesToExactlyZeroWithinFiftyMillisecondsWithoutPermission)
{
    Ticks ticks = Ticks::ramped_in();
    for (int i = 0; i < 10; ++i) ticks(along_x(3.0));
    for (int ms = 1; ms < 50; ++ms) {
        EXPECT_NEAR(ticks(along_x(3.0), false).x(), 3.0 * (1.0 - ms / 50.0), rounding) << ms;
    }
    for (int i = 0; i < 100; ++i) {
        const double force = ticks(along_x(3.0), false).x();
        EXPECT_EQ(i == 0 ? force < rounding : force == 0.0, true) << i << ": " << force;
    }
}

TEST(Governor, RampsInAgainFromWhereItsFadeHadCome)
{
    Ticks ticks = Ticks::ramped_in();
    for (int i = 0; i < 10; ++i) ticks(along_x(1.0));
    for (int ms = 0; ms < 25; ++ms) ticks(along_x(1.0), false);
    EXPECT_NEAR(ticks(along_x(1.0)).x(), 0.501, rounding);
    EXPECT_NEAR(ticks(along_x(1.0)).x(), 0.502, rounding);
}

TEST(Governor, GivesNothingToAHandThatWasNeverPermittedToFeel)
{
    Ticks ticks;
    for (int i = 0; i < 100; ++i) EXPECT_EQ(ticks(along_x(3.0), false), base::Force{});
}

TEST(Governor, AtZeroStrengthDropsTheForceWhateverTheSlewLimit)
{
    Ticks ticks = Ticks::ramped_in({.slew_max_n_per_s = 10.0, .fade_out = 5ms});
    for (int i = 0; i < 300; ++i) ticks(along_x(3.0));
    for (int ms = 1; ms <= 4; ++ms) EXPECT_GT(ticks(along_x(3.0), false).x(), 2.9) << ms;
    ticks(along_x(3.0), false);
    EXPECT_EQ(ticks(along_x(3.0), false), base::Force{});
}

TEST(Governor, ClampsTheNormAndKeepsTheDirection)
{
    Ticks ticks = Ticks::ramped_in();
    base::Force force;
    for (int i = 0; i < 10; ++i) force = ticks({{30.0, -40.0, 0.0}});
    EXPECT_NEAR(force.x(), 3.3 * 0.6, rounding);
    EXPECT_NEAR(force.y(), -3.3 * 0.8, rounding);
    EXPECT_EQ(force.z(), 0.0);
    EXPECT_EQ(ticks.governor.counters().clamped, 10U);
}

TEST(Governor, LetsAForceRiseByANewtonPerMillisecond)
{
    Ticks ticks = Ticks::ramped_in();
    EXPECT_NEAR(ticks(along_x(3.0)).x(), 1.0, rounding);
    EXPECT_NEAR(ticks(along_x(3.0)).x(), 2.0, rounding);
    EXPECT_NEAR(ticks(along_x(3.0)).x(), 3.0, rounding);
    EXPECT_NEAR(ticks(along_x(3.0)).x(), 3.0, rounding);
    EXPECT_NEAR(ticks(along_x(-3.0)).x(), 2.0, rounding);
    EXPECT_EQ(ticks.governor.counters().slewed, 3U); // the last step of the rise is exactly 1 N
}

TEST(Governor, GrantsALateTickNoLargerStepThanAPunctualOne)
{
    Ticks ticks = Ticks::ramped_in();
    EXPECT_NEAR(ticks.after(20ms - 1ns, along_x(3.0)).x(), 1.0, rounding);
    EXPECT_NEAR(ticks.after(5ms, along_x(3.0)).x(), 2.0, rounding);
    EXPECT_EQ(ticks.governor.counters().stalled, 0U);
}

TEST(Governor, StartsFromZeroAndRampsInAgainAfterAStallOfTheLoop)
{
    Ticks ticks = Ticks::ramped_in();
    EXPECT_NEAR(ticks.play(10, along_x(3.0)).x(), 3.0, rounding);
    EXPECT_EQ(ticks.after(20ms + 1ns, along_x(3.0)), base::Force{});
    EXPECT_FALSE(ticks.given.motors_on());
    ticks.play(500, along_x(3.0));
    EXPECT_NEAR(ticks(along_x(3.0)).x(), 3.0 * 0.501, rounding);
    EXPECT_EQ(ticks.governor.counters().stalled, 1U);
}

TEST(Governor, LimitsTheChangeAlongItsOwnDirection)
{
    Ticks ticks = Ticks::ramped_in();
    for (int i = 0; i < 3; ++i) ticks(along_x(3.0));
    const base::Force turned = ticks({{0.0, 3.0, 0.0}}); // a change of 3 * sqrt(2) N
    EXPECT_NEAR(turned.x(), 3.0 - std::sqrt(0.5), rounding);
    EXPECT_NEAR(turned.y(), std::sqrt(0.5), rounding);
}

TEST(Governor, MakesZeroOfWhatIsNotFiniteAtOnceAndStartsFromThereAfterwards)
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    Ticks ticks = Ticks::ramped_in();
    for (const base::Force& broken :
         {base::Force{{nan, 0.0, 0.0}}, base::Force{{0.0, infinity, 0.0}},
          base::Force{{0.0, 0.0, -infinity}}}) {
        for (int i = 0; i < 3; ++i) ticks(along_x(3.0));
        EXPECT_EQ(ticks(broken), base::Force{});
        EXPECT_NEAR(ticks(along_x(3.0)).x(), 1.0, rounding);
    }
    EXPECT_EQ(ticks.governor.counters().not_finite, 3U);
}

TEST(Governor, MakesZeroOfAFiniteForceTooLargeToMeasure)
{
    Ticks ticks = Ticks::ramped_in();
    const base::Force force = ticks(along_x(std::numeric_limits<double>::max()));
    EXPECT_TRUE(base::is_finite(force));
    EXPECT_LE(base::norm(force), 3.3);
}

TEST(Governor, CountsTheTicksAtLessThanFullStrength)
{
    Ticks ticks;
    for (int i = 0; i < 500; ++i) ticks({});
    EXPECT_EQ(ticks.governor.counters().faded, 500U);
    for (int i = 0; i < 1000; ++i) ticks({});
    // The first tick has no past; a rounding may take one more.
    EXPECT_NEAR(static_cast<double>(ticks.governor.counters().faded), 1000.0, 1.0);
    EXPECT_EQ(ticks.governor.counters().clamped, 0U);
    EXPECT_EQ(ticks.governor.counters().slewed, 0U);
}

} // namespace
} // namespace hapnet::device
