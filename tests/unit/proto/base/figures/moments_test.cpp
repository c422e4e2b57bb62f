// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/figures/moments.hpp"

#include <gtest/gtest.h>

namespace hapnet::base {
namespace {

using namespace std::chrono_literals;

TEST(RunningMoments, OfNothingAreNoMoments) { EXPECT_EQ(RunningMoments{}.moments(), std::nullopt); }

TEST(RunningMoments, OfASingleValueHaveNoDeviation)
{
    RunningMoments running;
    running.add(5ms);
    EXPECT_EQ(running.moments(), (Moments{5ms, std::nullopt}));
}

TEST(RunningMoments, AreThoseOfTheSample)
{
    RunningMoments running;
    for (const auto value : {2ms, 4ms, 4ms, 4ms, 5ms, 5ms, 7ms, 9ms}) running.add(value);
    EXPECT_EQ(running.count(), 8U);
    EXPECT_EQ(running.moments(), (Moments{5ms, 2'138'090ns})); // sqrt(32 / 7) ms
}

TEST(RunningMoments, KeepTheirDigitsFarFromZero)
{
    RunningMoments running;
    for (int i = 0; i < 1000; ++i) running.add(1h + i % 2 * 2us);
    EXPECT_EQ(running.moments(), (Moments{1h + 1us, 1001ns})); // sqrt(1000 / 999) us
}

TEST(RunningMoments, RoundHalfANanosecondUp)
{
    RunningMoments running;
    running.add(1ns);
    running.add(2ns);
    EXPECT_EQ(running.moments()->mean, 2ns);
    EXPECT_EQ(nearest_duration(-1.5), -1ns);
}

} // namespace
} // namespace hapnet::base
