// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/learn/likeness.hpp"

#include <chrono>
#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::emulator::tools {
namespace {

using namespace std::chrono_literals;

MeasuredWay way_of(std::initializer_list<std::optional<base::Duration>> delays,
                   std::optional<base::Duration> spacing = std::nullopt)
{
    MeasuredWay way{.spacing = spacing};
    for (const auto& delay : delays) way.add(delay, !delay);
    return way;
}

TEST(Likeness, CutsASeriesInTheMiddle)
{
    const auto [first, second] = halves_of(way_of({1ms, 2ms, std::nullopt, 4ms, 5ms}, 10ms));
    EXPECT_EQ(first.delays, way_of({1ms, 2ms, std::nullopt}).delays);
    EXPECT_EQ(second.delays, way_of({4ms, 5ms}).delays);
    EXPECT_EQ(second.lost, (std::vector<bool>{false, false}));
    EXPECT_EQ(second.spacing, std::optional<base::Duration>{10ms});
}

TEST(Likeness, FindsTheStepOfASeries)
{
    EXPECT_EQ(resolution_of(way_of({1ms, 20ms, std::nullopt})), base::Duration{1ms});
    EXPECT_EQ(resolution_of(way_of({1ms, 20'100us})), base::Duration{100us});
    EXPECT_EQ(resolution_of(way_of({1ms, 20'110us})), base::Duration{10us});
    EXPECT_EQ(resolution_of(way_of({1ms, 20'111us})), base::Duration{1us});
}

TEST(Likeness, MeasuresTheLargestDistanceOfTwoDistributions)
{
    const auto a = way_of({1ms, 2ms, 3ms, 4ms});
    EXPECT_DOUBLE_EQ(distance_between(a, a), 0.0);
    EXPECT_DOUBLE_EQ(distance_between(a, way_of({3ms, 4ms, 5ms, 6ms})), 0.5);
    EXPECT_DOUBLE_EQ(distance_between(a, way_of({9ms})), 1.0);
    EXPECT_DOUBLE_EQ(distance_between(a, way_of({1ms, 2ms, std::nullopt, 3ms, 4ms})), 0.0);
}

TEST(Likeness, CorrelatesDelaysThatAreSoFarApart)
{
    // A period of 1 s: equal after a whole one, opposite after a half.
    MeasuredWay way{.spacing = 100ms};
    for (int i = 0; i < 409; ++i) way.add(i % 10 < 5 ? 10ms : 20ms, false);
    EXPECT_EQ(autocorrelation(way, 1s), std::nullopt); // of 399 pairs
    for (int i = 409; i < 420; ++i) way.add(i % 10 < 5 ? 10ms : 20ms, false);
    EXPECT_NEAR(autocorrelation(way, 1s).value(), 1.0, 0.01);
    EXPECT_NEAR(autocorrelation(way, 500ms).value(), -1.0, 0.01);
    EXPECT_EQ(autocorrelation(way, 15s), std::nullopt); // 420 rows are 42 s
    way.spacing.reset();
    EXPECT_EQ(autocorrelation(way, 1s), std::nullopt);
}

TEST(Likeness, CountsLossesRightAfterSlowDatagrams)
{
    MeasuredWay way;
    for (int i = 0; i < 1000; ++i) {
        const bool is_slow = i % 20 == 0;
        way.add(is_slow ? 50ms : 10ms, i % 20 == 1 && i % 40 == 1);
    }
    const auto slow = losses_when_slow(way);
    EXPECT_EQ(slow, std::nullopt); // 25 losses
    for (int i = 0; i < 1000; ++i) way.add(i % 20 == 0 ? 50ms : 10ms, i % 40 == 1);
    const auto more = losses_when_slow(way);
    ASSERT_TRUE(more);
    EXPECT_EQ(more->delays, 100U);
    EXPECT_DOUBLE_EQ(more->share, 0.5);
}

TEST(Likeness, PlaysConditionsAsAMeasurementSeesThem)
{
    Conditions conditions{.delay = constant(20ms)};
    conditions.jitter.law = UniformLaw{0ms, 5ms};
    const auto way = played(conditions, 5000, 10ms, 1ms);
    ASSERT_EQ(way.delays.size(), 5000U);
    double sum = 0.0;
    for (const auto& delay : way.delays) {
        ASSERT_TRUE(delay);
        EXPECT_EQ(*delay % base::Duration{1ms}, base::Duration{0});
        sum += base::to_seconds(*delay);
    }
    EXPECT_NEAR(sum / 5000.0, 0.020, 3.0 * 0.0029 / std::sqrt(5000.0) + 1e-4);
}

TEST(Likeness, TellsWhetherConditionsAreThoseOfASeries)
{
    Conditions right{.delay = constant(20ms)};
    right.jitter.law = UniformLaw{0ms, 5ms};
    const auto measured = played(right, 20'000, 10ms, 1us);
    EXPECT_TRUE(is_near(right, measured));
    Conditions other = right;
    other.delay = constant(21ms);
    EXPECT_FALSE(is_near(other, measured)); // 0.1 apart
    other = right;
    other.jitter.correlation_time = 2s; // at 1 s: 0.6
    EXPECT_FALSE(is_near(other, measured));
}

} // namespace
} // namespace hapnet::emulator::tools
