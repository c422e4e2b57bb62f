// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/figures/quantiles.hpp"

#include <gtest/gtest.h>

namespace hapnet::base {
namespace {

using namespace std::chrono_literals;

TEST(DurationSample, OfNothingHasNoQuantiles)
{
    EXPECT_EQ(DurationSample{}.quantiles(), std::nullopt);
    EXPECT_EQ(DurationSample{}.count(), 0U);
}

TEST(DurationSample, OfOneValueHasItAsEveryQuantile)
{
    DurationSample sample;
    sample.add(-3ms);
    EXPECT_EQ(sample.quantiles(), (Quantiles{-3ms, -3ms, -3ms, -3ms, -3ms}));
}

TEST(DurationSample, TakesTheNearestRankWhateverTheOrder)
{
    DurationSample sample;
    for (int i = 1; i <= 1000; ++i) sample.add(i * 7919 % 1009 * 1us); // 1009 is prime
    DurationSample ascending;
    for (int i = 1; i <= 1000; ++i) ascending.add(i * 1ms);
    EXPECT_EQ(ascending.quantiles(), (Quantiles{500ms, 900ms, 990ms, 999ms, 1000ms}));
    EXPECT_EQ(sample.values().front(), 7919 % 1009 * 1us);
    auto sorted = sample.values();
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(sample.quantiles(),
              (Quantiles{sorted[499], sorted[899], sorted[989], sorted[998], sorted[999]}));
}

TEST(DurationSample, P99LeavesTheWorstOfAHundredOut)
{
    DurationSample sample;
    for (int i = 0; i < 99; ++i) sample.add(1ms);
    sample.add(9ms);
    EXPECT_EQ(sample.quantiles(), (Quantiles{1ms, 1ms, 1ms, 9ms, 9ms}));
    sample.add(9ms);
    EXPECT_EQ(sample.quantiles()->p99, 9ms);
}

} // namespace
} // namespace hapnet::base
