// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/timer.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::peer {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint began{1h};

TEST(FixedRateTimer, IsDueAtAFixedRateWhateverATickTakes)
{
    FixedRateTimer timer{began, 1ms};
    for (int tick = 1; tick < 100; ++tick) {
        EXPECT_EQ(timer.next(), began + tick * 1ms);
        const TickTime time = timer.begin(timer.next() + 30us);
        EXPECT_EQ(time.late, 30us);
        EXPECT_EQ(time.missed_before, 0U);
        timer.end(time.due + 900us);
    }
}

TEST(FixedRateTimer, SkipsTheTicksWhoseTimeHasPassedAndCountsThem)
{
    FixedRateTimer timer{began, 1ms};
    timer.end(began + 2ms + 999us); // the next one is late, but still in its time
    EXPECT_EQ(timer.next(), began + 2ms);
    EXPECT_EQ(timer.begin(began + 2ms + 999us).missed_before, 0U);
    timer.end(began + 6ms + 1us); // those due at 3, 4 and 5 ms
    EXPECT_EQ(timer.next(), began + 6ms);
    EXPECT_EQ(timer.begin(began + 6ms + 1us).missed_before, 3U);
    timer.end(began + 6ms + 500us);
    EXPECT_EQ(timer.begin(timer.next()).missed_before, 0U);
}

TEST(DeviceTimer, BeginsATickAtEveryCycleAndCallsAPunctualOneNeverLate)
{
    DeviceTimer timer{1ms};
    for (int cycle = 0; cycle < 100; ++cycle) {
        const auto time = timer.at(began + cycle * 1ms);
        ASSERT_TRUE(time);
        EXPECT_EQ(time->due, began + cycle * 1ms);
        EXPECT_EQ(time->late, 0ns);
        EXPECT_EQ(time->missed_before, 0U);
    }
}

TEST(DeviceTimer, CountsCyclesThatNeverCame)
{
    DeviceTimer timer{1ms};
    std::ignore = timer.at(began);
    const auto time = timer.at(began + 4ms + 200us);
    ASSERT_TRUE(time);
    EXPECT_EQ(time->missed_before, 3U);
    EXPECT_EQ(time->due, began + 4ms);
    EXPECT_EQ(time->late, 200us);
}

TEST(DeviceTimer, SkipsCyclesOfADeviceThatIsFasterThanTheSession)
{
    DeviceTimer timer{1ms};
    int ticks = 0;
    std::uint32_t missed = 0;
    for (int cycle = 0; cycle < 4000; ++cycle) {
        const auto time = timer.at(began + cycle * 250us);
        ticks += time ? 1 : 0;
        missed += time ? time->missed_before : 0;
    }
    EXPECT_NEAR(ticks, 1000, 1);
    EXPECT_EQ(missed, 0U);
}

TEST(DeviceTimer, FollowsAClockThatIsATenThousandthOffWithoutCallingItLate)
{
    for (const auto period : {1ms - 100ns, 1ms + 100ns}) {
        DeviceTimer timer{1ms};
        for (int cycle = 0; cycle < 100'000; ++cycle) {
            const auto time = timer.at(began + cycle * period);
            ASSERT_TRUE(time) << cycle;
            ASSERT_EQ(time->missed_before, 0U) << cycle;
            ASSERT_LE(time->late, 3200ns) << cycle; // 32 times its error in a cycle
        }
    }
}

TEST(DeviceTimer, CallsJitterLate)
{
    DeviceTimer timer{1ms};
    base::Duration latest{};
    for (int cycle = 0; cycle < 3200; ++cycle) {
        const auto late = cycle % 32 == 31 ? 300us : 0us;
        const auto time = timer.at(began + cycle * 1ms + late);
        ASSERT_TRUE(time);
        // Also when it comes early, as all ticks do for a while after a late one.
        EXPECT_EQ(time->due + time->late, began + cycle * 1ms + late);
        latest = std::max(latest, time->late);
    }
    EXPECT_GT(latest, 280us);
    EXPECT_LE(latest, 300us);
}

} // namespace
} // namespace hapnet::peer
