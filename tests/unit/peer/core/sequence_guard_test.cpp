// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sequence_guard.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::peer {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint guard_start{1h};

/// States as an honest side sends them: number n at guard_start + n ms, on a clock 7 h ahead.
struct Stream {
    SequenceGuard guard{1ms};
    base::Duration delay{40ms};

    [[nodiscard]] static wire::State state(std::uint32_t number)
    {
        wire::State sent;
        sent.sequence = number;
        sent.sent = guard_start + 7h + number * 1ms;
        return sent;
    }
    [[nodiscard]] base::TimePoint arrival(std::uint32_t number) const
    {
        return guard_start + number * 1ms + delay;
    }
    /// Returns whether the state is admitted, and then counts it.
    bool give(std::uint32_t number)
    {
        const bool admitted = guard.admits(state(number), arrival(number));
        if (admitted) guard.on_taken(state(number), arrival(number));
        return admitted;
    }
    void give_all(std::uint32_t first, std::uint32_t last)
    {
        for (std::uint32_t number = first; number <= last; ++number) {
            ASSERT_TRUE(give(number)) << number;
        }
    }
};

TEST(SequenceGuard, RefusesANumberAheadOfItsStamp)
{
    Stream stream;
    stream.give_all(1, 1000);
    wire::State forged = Stream::state(1001);
    forged.sequence += 900;
    EXPECT_FALSE(stream.guard.admits(forged, stream.arrival(1001)));
    forged.sequence = 1001 + 51;
    EXPECT_FALSE(stream.guard.admits(forged, stream.arrival(1001)));
    forged.sequence = 1001 + 50;
    EXPECT_TRUE(stream.guard.admits(forged, stream.arrival(1001)));
}

TEST(SequenceGuard, RefusesAStampAheadOfItsArrival)
{
    Stream stream;
    stream.give_all(1, 1000);
    EXPECT_FALSE(stream.guard.admits(Stream::state(1901), stream.arrival(1001)));
    EXPECT_FALSE(stream.guard.admits(Stream::state(1502), stream.arrival(1001)));
    EXPECT_TRUE(stream.guard.admits(Stream::state(1501), stream.arrival(1001)));
}

TEST(SequenceGuard, IsNotLedAwayByForgedStatesThatItAdmits)
{
    Stream stream;
    stream.give_all(1, 1000);
    std::uint32_t most = 0;
    for (std::uint32_t number = 1001; number < 4000; ++number) {
        ASSERT_TRUE(stream.give(number));
        if (number % 100 != 0) continue; // ten a second, each as far ahead as the guard admits
        wire::State forged = Stream::state(number);
        while (forged.sequence += 1, stream.guard.admits(forged, stream.arrival(number))) {}
        forged.sequence -= 1;
        stream.guard.on_taken(forged, stream.arrival(number));
        most = std::max(most, forged.sequence - number);
    }
    EXPECT_LE(most, 55U);
}

TEST(SequenceGuard, AdmitsWhatAnHonestSideAndAnHonestPathDo)
{
    Stream stream;
    stream.give_all(1, 500);
    EXPECT_TRUE(stream.give(490)); // overtaken
    EXPECT_TRUE(stream.give(490)); // twice
    stream.delay = 5ms;            // another path
    stream.give_all(501, 700);
    stream.delay = 2s; // a queue fills, and nothing arrives
    stream.give_all(701, 2000);
    for (std::uint32_t number = 2001; number < 6000; ++number) { // ... and empties
        stream.delay = std::max<base::Duration>(5ms, stream.delay - 500us);
        ASSERT_TRUE(stream.give(number)) << number;
    }
    // A loop that stood still for 2 s continues its numbers, so its stamps are ahead of them.
    wire::State late = Stream::state(6000);
    late.sent += 2s;
    EXPECT_TRUE(stream.guard.admits(late, stream.arrival(8000)));
}

TEST(SequenceGuard, FollowsADeviceThatSetsAFasterPace)
{
    SequenceGuard guard{1ms};
    for (std::uint32_t number = 1; number < 100'000; ++number) { // 1.4 % faster
        wire::State state;
        state.sequence = number;
        state.sent = guard_start + number * base::Duration{986'000};
        ASSERT_TRUE(guard.admits(state, state.sent + 3ms)) << number;
        guard.on_taken(state, state.sent + 3ms);
    }
}

TEST(SequenceGuard, BeginsAnewAfterASilence)
{
    Stream stream;
    stream.give_all(1, 1000);
    wire::State other = Stream::state(1300);
    other.sequence = 5000;
    EXPECT_FALSE(stream.guard.admits(other, stream.arrival(1299)));
    EXPECT_TRUE(stream.guard.admits(other, stream.arrival(1300)));
    stream.guard.forget();
    EXPECT_TRUE(stream.guard.admits(other, stream.arrival(1001)));
}

TEST(SequenceGuard, FollowsWhoSendsInOneTickOfTen)
{
    SequenceGuard guard{1ms};
    wire::State state;
    base::TimePoint arrived = guard_start;
    for (std::uint32_t number = 1; number <= 1000; ++number) {
        state.sequence = number;
        state.sent = guard_start + 7h + number * 10ms;
        arrived = guard_start + number * 10ms + 40ms;
        ASSERT_TRUE(guard.admits(state, arrived)) << number;
        guard.on_taken(state, arrived);
    }
    state.sequence += 60; // 50 ms is what may be made up for
    EXPECT_FALSE(guard.admits(state, arrived));
}

} // namespace
} // namespace hapnet::peer
