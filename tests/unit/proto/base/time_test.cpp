// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/time.hpp"

#include <gtest/gtest.h>

namespace hapnet::base {
namespace {

using namespace std::chrono_literals;

constexpr TimePoint noon{12h};

TEST(Time, ADeadlineIsDueAtItsNanosecondAndNotBefore)
{
    EXPECT_FALSE(is_due(noon, noon - 1ns));
    EXPECT_TRUE(is_due(noon, noon));
    EXPECT_TRUE(is_due(noon, noon + 1h));
}

TEST(Time, NoDeadlineIsNeverDue)
{
    EXPECT_FALSE(is_due(std::nullopt, TimePoint::min()));
    EXPECT_FALSE(is_due(std::nullopt, TimePoint::max()));
}

TEST(Time, NeverIsLaterThanAnyDeadline)
{
    EXPECT_EQ(earlier(noon, std::nullopt), noon);
    EXPECT_EQ(earlier(std::nullopt, noon), noon);
    EXPECT_EQ(earlier(std::nullopt, std::nullopt), std::nullopt);
    EXPECT_EQ(earlier(noon, noon - 1ns), noon - 1ns);
    EXPECT_EQ(earlier(noon - 1ns, noon), noon - 1ns);
}

TEST(Time, SecondsRoundToTheNearestNanosecondAndAwayFromZero)
{
    EXPECT_EQ(from_seconds(0.16), 160ms);
    EXPECT_EQ(from_seconds(1.4e-9), 1ns);
    EXPECT_EQ(from_seconds(1.6e-9), 2ns);
    EXPECT_EQ(from_seconds(2.5e-9), 3ns);
    EXPECT_EQ(from_seconds(-2.5e-9), -3ns);
    EXPECT_EQ(from_seconds(-0.16), -160ms);
    EXPECT_EQ(from_seconds(0.0), 0ns);
}

TEST(Time, SecondsOfADurationAreExactForWholeMicroseconds)
{
    EXPECT_EQ(to_seconds(1ms), 0.001);
    EXPECT_EQ(to_seconds(-1500us), -0.0015);
}

} // namespace
} // namespace hapnet::base
