// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/secure/initiation_dates.hpp"

#include <gtest/gtest.h>

namespace hapnet::secure {

namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start;
constexpr base::TimePoint later = start + InitiationDates::unconfirmed_lasts;

} // namespace

TEST(InitiationDates, TakesEachOnceAndOfOneRunOnlyNewerOnes)
{
    InitiationDates dates;
    EXPECT_TRUE(dates.take(1, -5, start));
    EXPECT_FALSE(dates.take(1, -5, later));
    EXPECT_FALSE(dates.take(1, -6, later + 100h));
    EXPECT_TRUE(dates.take(1, -4, later));
}

TEST(InitiationDates, TakesNothingOlderThanAConfirmedOneOfAnyRun)
{
    InitiationDates dates;
    EXPECT_TRUE(dates.take(1, 1000, start));
    dates.confirm(1000);
    EXPECT_FALSE(dates.take(2, 999, later + 100h));
    EXPECT_FALSE(dates.take(2, 1000, later + 100h));
    EXPECT_TRUE(dates.take(2, 1001, start));
}

TEST(InitiationDates, LetAnUnconfirmedOneShutOtherRunsOutForAWhileOnly)
{
    InitiationDates dates;
    EXPECT_TRUE(dates.take(1, 1000, start));
    EXPECT_FALSE(dates.take(2, 10, later - 1ns));
    EXPECT_TRUE(dates.take(3, 1001, later - 1ns)); // a newer one never waits
    EXPECT_FALSE(dates.take(2, 10, later));
    EXPECT_TRUE(dates.take(2, 10, later - 1ns + InitiationDates::unconfirmed_lasts));
    EXPECT_FALSE(dates.take(1, 1000, later + 100h)); // and is not taken again
}

TEST(InitiationDates, ForgetTheRunThatCameLongestAgoWhenThereAreMoreThanTheyRemember)
{
    InitiationDates dates;
    constexpr auto runs = static_cast<std::uint32_t>(InitiationDates::runs_max);
    for (std::uint32_t run = 1; run <= runs; ++run)
        EXPECT_TRUE(dates.take(run, run, start + run * 1ms));
    for (std::uint32_t run = 1; run <= runs; ++run) EXPECT_FALSE(dates.take(run, run, start + 1h));
    EXPECT_TRUE(dates.take(runs + 1, runs + 1, start + 1h));
    EXPECT_FALSE(dates.take(2, 2, start + 2h));
    EXPECT_TRUE(dates.take(1, 1, start + 2h));
}

} // namespace hapnet::secure
