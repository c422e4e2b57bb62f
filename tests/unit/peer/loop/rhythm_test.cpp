// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/loop/rhythm.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::peer {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint began{1h};

TEST(OwnRhythm, IsDueEveryTickWhateverATurnTakes)
{
    OwnRhythm rhythm{began, 1ms};
    for (int turn = 1; turn < 100; ++turn) {
        EXPECT_EQ(rhythm.next(), began + turn * 1ms);
        const Beat beat = rhythm.begin(rhythm.next() + 30us);
        EXPECT_EQ(beat.late, 30us);
        EXPECT_EQ(beat.missed_before, 0U);
        rhythm.end(beat.due + 900us);
    }
}

TEST(OwnRhythm, SkipsTheTurnsWhoseTimeHasPassedAndCountsThem)
{
    OwnRhythm rhythm{began, 1ms};
    rhythm.end(began + 2ms + 999us); // the next one is late, but still in its time
    EXPECT_EQ(rhythm.next(), began + 2ms);
    EXPECT_EQ(rhythm.begin(began + 2ms + 999us).missed_before, 0U);
    rhythm.end(began + 6ms + 1us); // those due at 3, 4 and 5 ms
    EXPECT_EQ(rhythm.next(), began + 6ms);
    EXPECT_EQ(rhythm.begin(began + 6ms + 1us).missed_before, 3U);
    rhythm.end(began + 6ms + 500us);
    EXPECT_EQ(rhythm.begin(rhythm.next()).missed_before, 0U);
}

TEST(DeviceRhythm, CallsEveryCycleATurnAndAPunctualOneNeverLate)
{
    DeviceRhythm rhythm{1ms};
    for (int cycle = 0; cycle < 100; ++cycle) {
        const auto beat = rhythm.at(began + cycle * 1ms);
        ASSERT_TRUE(beat);
        EXPECT_EQ(beat->due, began + cycle * 1ms);
        EXPECT_EQ(beat->late, 0ns);
        EXPECT_EQ(beat->missed_before, 0U);
    }
}

TEST(DeviceRhythm, CountsCyclesThatNeverCame)
{
    DeviceRhythm rhythm{1ms};
    std::ignore = rhythm.at(began);
    const auto beat = rhythm.at(began + 4ms + 200us);
    ASSERT_TRUE(beat);
    EXPECT_EQ(beat->missed_before, 3U);
    EXPECT_EQ(beat->due, began + 4ms);
    EXPECT_EQ(beat->late, 200us);
}

TEST(DeviceRhythm, SkipsCyclesOfADeviceThatIsFasterThanTheSession)
{
    DeviceRhythm rhythm{1ms};
    int turns = 0;
    std::uint32_t missed = 0;
    for (int cycle = 0; cycle < 4000; ++cycle) {
        const auto beat = rhythm.at(began + cycle * 250us);
        turns += beat ? 1 : 0;
        missed += beat ? beat->missed_before : 0;
    }
    EXPECT_NEAR(turns, 1000, 1);
    EXPECT_EQ(missed, 0U);
}

TEST(DeviceRhythm, FollowsAClockThatIsATenThousandthOffWithoutCallingItLate)
{
    for (const auto period : {1ms - 100ns, 1ms + 100ns}) {
        DeviceRhythm rhythm{1ms};
        for (int cycle = 0; cycle < 100'000; ++cycle) {
            const auto beat = rhythm.at(began + cycle * period);
            ASSERT_TRUE(beat) << cycle;
            ASSERT_EQ(beat->missed_before, 0U) << cycle;
            ASSERT_LE(beat->late, 3200ns) << cycle; // 32 times what it is off by in a cycle
        }
    }
}

TEST(DeviceRhythm, CallsJitterLate)
{
    DeviceRhythm rhythm{1ms};
    base::Duration latest{};
    for (int cycle = 0; cycle < 3200; ++cycle) {
        const auto late = cycle % 32 == 31 ? 300us : 0us;
        const auto beat = rhythm.at(began + cycle * 1ms + late);
        ASSERT_TRUE(beat);
        // Also of a turn before its time, as all after a late one are for a while.
        EXPECT_EQ(beat->due + beat->late, began + cycle * 1ms + late);
        latest = std::max(latest, beat->late);
    }
    EXPECT_GT(latest, 280us);
    EXPECT_LE(latest, 300us);
}

} // namespace
} // namespace hapnet::peer
