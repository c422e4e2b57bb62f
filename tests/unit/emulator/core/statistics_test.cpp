// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/statistics.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::emulator {

namespace {

using namespace std::chrono_literals;

} // namespace

TEST(Statistics, OfNothingArePunctual) { EXPECT_TRUE(Statistics{}.is_punctual(0ns)); }

TEST(Statistics, ArePunctualAsLongAsOneInAHundredIsLate)
{
    Statistics statistics;
    for (int i = 0; i < 99; ++i) statistics.lateness.add(10us);
    statistics.lateness.add(5ms);
    EXPECT_TRUE(statistics.is_punctual(1ms));
    statistics.lateness.add(5ms);
    EXPECT_FALSE(statistics.is_punctual(1ms));
}

TEST(Statistics, OfSeveralPathsAddUpToTheSameIdentity)
{
    Statistics one;
    one.received = 10;
    one.duplicated = 2;
    one.delivered = 7;
    one.in_flight = 1;
    one.dropped[DropCause::random_loss] = 4;
    one.lateness.add(10us);
    Statistics sum = one;
    sum.add(one);
    EXPECT_EQ(sum.received + sum.duplicated, sum.delivered + sum.dropped_total() + sum.in_flight);
    EXPECT_EQ(sum.received, 20U);
    EXPECT_EQ(sum.lateness.count(), 2U);
    EXPECT_EQ(sum.lateness.max(), 10us);
}

TEST(Statistics, SumDropsOverAllCauses)
{
    Statistics statistics;
    for (const DropCause cause : drop_causes) statistics.dropped[cause] = 2;
    EXPECT_EQ(statistics.dropped_total(), 2 * drop_causes.size());
}

} // namespace hapnet::emulator
