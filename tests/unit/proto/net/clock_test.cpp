// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/clock.hpp"
#include "proto/net/stop_signal.hpp"
#include "proto/net/wait.hpp"

#include <array>
#include <csignal>
#include <gtest/gtest.h>

namespace hapnet::net {
namespace {

using namespace std::chrono_literals;

TEST(Clock, NeverRunsBackwards)
{
    auto last = monotonic_now();
    for (int i = 0; i < 10'000; ++i) {
        const auto now = monotonic_now();
        ASSERT_GE(now, last);
        last = now;
    }
}

TEST(Clock, SleepingUntilAPastMomentReturnsAtOnce)
{
    sleep_until(base::TimePoint{});
    sleep_until(monotonic_now() - 1ns);
}

TEST(Clock, OneBootHasOneIdentity)
{
    EXPECT_EQ(boot_id(), boot_id());
    EXPECT_EQ(boot_id().size(), 36U);
}

TEST(Clock, UnpredictableBitsDiffer) { EXPECT_NE(unpredictable_bits(), unpredictable_bits()); }

TEST(Wait, EndsAtItsDeadlineAndNotBeforeIt)
{
    const auto deadline = monotonic_now() + 1ms;
    wait_readable({}, deadline);
    EXPECT_GE(monotonic_now(), deadline);
}

TEST(Wait, EndsAtOnceWhenTheDeadlineHasPassed)
{
    wait_readable({}, base::TimePoint{});
    wait_readable({}, monotonic_now() - 1h);
}

TEST(StopSignal, TurnsASignalIntoSomethingToRead)
{
    StopSignal stop;
    EXPECT_FALSE(stop.requested());
    ASSERT_EQ(raise(SIGTERM), 0);
    wait_readable(std::array{stop.descriptor()}, std::nullopt);
    EXPECT_TRUE(stop.requested());
    EXPECT_TRUE(stop.requested()); // stays true
    EXPECT_FALSE(stop.reload_requested());
}

TEST(StopSignal, TakesAHangupForAStopUnlessItMeansReload)
{
    {
        StopSignal stop;
        ASSERT_EQ(raise(SIGHUP), 0);
        EXPECT_TRUE(stop.requested());
    }
    StopSignal stop{Hangup::reload};
    ASSERT_EQ(raise(SIGHUP), 0);
    EXPECT_FALSE(stop.requested());
    EXPECT_TRUE(stop.reload_requested());
    EXPECT_FALSE(stop.reload_requested()); // consumed
}

} // namespace
} // namespace hapnet::net
