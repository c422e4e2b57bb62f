// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/clock_offset.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::peer::clock_offset_test {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{1h};

/// A message of ours at `sent`, `there` on its way to a side whose clock is `ahead`, answered
/// after `age`, and `back` on the way back.
ClockSample sample(base::TimePoint sent, base::Duration there, base::Duration back,
                   base::Duration ahead, base::Duration age = 3ms)
{
    const base::TimePoint heard = sent + there + ahead;
    return {sent, heard, heard + age, sent + there + age + back};
}

TEST(ClockOffset, IsUnknownBeforeTheFirstSample) { EXPECT_FALSE(ClockOffset{}.estimate()); }

TEST(ClockOffset, IsExactWhenBothWaysTakeEquallyLong)
{
    for (const base::Duration ahead :
         {base::Duration{0}, base::Duration{5s}, base::Duration{-9h}}) {
        ClockOffset clock;
        clock.add(sample(start, 160ms, 160ms, ahead));
        ASSERT_TRUE(clock.estimate());
        EXPECT_EQ(clock.estimate()->offset, ahead);
        EXPECT_EQ(clock.estimate()->uncertainty, 160ms);
    }
}

TEST(ClockOffset, ErrsByHalfTheAsymmetryAndSaysThatItMay)
{
    ClockOffset clock;
    clock.add(sample(start, 300ms, 100ms, 7s));
    ASSERT_TRUE(clock.estimate());
    EXPECT_EQ(clock.estimate()->offset - 7s, 100ms);
    EXPECT_EQ(clock.estimate()->uncertainty, 200ms);
    EXPECT_LE(std::chrono::abs(clock.estimate()->offset - 7s), clock.estimate()->uncertainty);
}

TEST(ClockOffset, DoesNotCountTheTimeThatTheAnswerTook)
{
    ClockOffset clock;
    clock.add(sample(start, 10ms, 10ms, 1s, 400ms));
    EXPECT_EQ(clock.estimate()->uncertainty, 10ms);
    EXPECT_EQ(clock.estimate()->offset, 1s);
}

TEST(ClockOffset, TrustsTheShortestRoundTrip)
{
    ClockOffset clock;
    clock.add(sample(start, 90ms, 50ms, 1s));
    clock.add(sample(start + 10ms, 40ms, 40ms, 1s));
    clock.add(sample(start + 20ms, 50ms, 90ms, 1s));
    EXPECT_EQ(clock.estimate()->offset, 1s);
    EXPECT_EQ(clock.estimate()->uncertainty, 40ms);
}

TEST(ClockOffset, ForgetsAShortRoundTripAfterTwoSecondsAtMost)
{
    ClockOffset clock;
    clock.add(sample(start, 10ms, 10ms, 1s));
    for (auto later = base::Duration{20ms}; later <= 2100ms; later += 20ms) {
        clock.add(sample(start + later, 50ms, 50ms, 2s));
        if (later <= 900ms) {
            EXPECT_EQ(clock.estimate()->offset, 1s) << later.count();
        }
    }
    EXPECT_EQ(clock.estimate()->offset, 2s);
}

TEST(ClockOffset, IgnoresSamplesWithANegativeRoundTrip)
{
    ClockOffset clock;
    clock.add({start, start + 5ms, start + 50ms, start + 10ms});
    EXPECT_FALSE(clock.estimate());
}

TEST(ClockOffset, IsUnknownAgainAfterAReset)
{
    ClockOffset clock;
    clock.add(sample(start, 10ms, 10ms, 1s));
    clock.reset();
    EXPECT_FALSE(clock.estimate());
}

} // namespace
} // namespace hapnet::peer::clock_offset_test
