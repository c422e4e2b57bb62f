// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/clock_sync.hpp"

#include "proto/base/random.hpp"

#include <chrono>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>

namespace hapnet::peer::clock_sync_test {
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

/// Echoes every 10 ms for a while, through a path that delays each way by `least` and an
/// exponential queue with this mean; `ahead` is the other clock's lead at a time since the start.
struct Path {
    base::Duration least{40ms};
    base::Duration queue{0};
    std::function<base::Duration(base::Duration)> ahead = [](base::Duration) {
        return base::Duration{5s};
    };
    std::uint64_t seed = 1;
    std::uint64_t next = 0;
    base::Duration at{0};

    void play(ClockSync& clock, base::Duration time,
              const std::function<void(base::Duration)>& look = {})
    {
        const auto stream = base::Seed{seed}.stream("queue");
        const auto drawn = [&](std::uint32_t way) {
            const double share = -std::log(1.0 - stream.uniform(next, way));
            return least + std::chrono::duration_cast<base::Duration>(queue * share);
        };
        for (const base::Duration end = at + time; at < end; at += 10ms, ++next) {
            clock.add(sample(start + at, drawn(0), drawn(1), ahead(at)));
            if (look) look(at);
        }
    }
};

double ms(base::Duration time) { return 1e3 * base::to_seconds(time); }

} // namespace

TEST(ClockSync, IsUnknownBeforeTheFirstSample) { EXPECT_FALSE(ClockSync{}.estimate()); }

TEST(ClockSync, IsExactWhenBothWaysTakeEquallyLong)
{
    for (const base::Duration ahead :
         {base::Duration{0}, base::Duration{5s}, base::Duration{-9h}}) {
        ClockSync clock;
        clock.add(sample(start, 160ms, 160ms, ahead));
        ASSERT_TRUE(clock.estimate());
        EXPECT_EQ(clock.estimate()->offset, ahead);
        EXPECT_EQ(clock.estimate()->uncertainty, 160ms);
    }
}

TEST(ClockSync, StaysExactToTheNanosecondOnASteadyPath)
{
    ClockSync clock;
    Path path;
    path.play(clock, 100s, [&clock](base::Duration) {
        ASSERT_EQ(clock.estimate()->offset, 5s);
        ASSERT_EQ(clock.estimate()->uncertainty, 40ms);
        ASSERT_EQ(clock.estimate()->skew_ppm, 0.0);
    });
}

TEST(ClockSync, ErrsByHalfTheAsymmetryAndSaysThatItMay)
{
    ClockSync clock;
    clock.add(sample(start, 300ms, 100ms, 7s));
    ASSERT_TRUE(clock.estimate());
    EXPECT_EQ(clock.estimate()->offset - 7s, 100ms);
    EXPECT_EQ(clock.estimate()->uncertainty, 200ms);
}

TEST(ClockSync, DoesNotCountTheTimeThatTheAnswerTook)
{
    ClockSync clock;
    clock.add(sample(start, 10ms, 10ms, 1s, 400ms));
    EXPECT_EQ(clock.estimate()->uncertainty, 10ms);
    EXPECT_EQ(clock.estimate()->offset, 1s);
}

TEST(ClockSync, TrustsTheShortestRoundTripWhileItSettles)
{
    ClockSync clock;
    clock.add(sample(start, 90ms, 50ms, 1s));
    clock.add(sample(start + 10ms, 40ms, 40ms, 1s));
    clock.add(sample(start + 20ms, 60ms, 40ms, 1s));
    EXPECT_EQ(clock.estimate()->offset, 1s);
    EXPECT_EQ(clock.estimate()->uncertainty, 40ms);
}

TEST(ClockSync, IgnoresSamplesWithANegativeRoundTripOrADecadeApart)
{
    ClockSync clock;
    clock.add({start, start + 5ms, start + 90ms, start + 50ms});
    clock.add(sample(start, 10ms, 10ms, std::chrono::hours{11 * 365 * 24}));
    EXPECT_FALSE(clock.estimate());
}

TEST(ClockSync, FindsTheSkewBehindQueues)
{
    for (const double ppm : {-150.0, -20.0, 0.0, 3.0, 80.0, 180.0}) {
        ClockSync clock;
        Path path;
        path.queue = 5ms;
        path.ahead = [ppm](base::Duration at) {
            return 5s + std::chrono::duration_cast<base::Duration>(1e-6 * ppm * at);
        };
        path.play(clock, 90s);
        const auto estimate = clock.estimate();
        EXPECT_NEAR(estimate->skew_ppm, ppm, 8.0);
        const base::Duration error = estimate->offset - path.ahead(path.at);
        EXPECT_LT(std::abs(ms(error)), 0.5) << ppm;
        EXPECT_LE(std::chrono::abs(error), estimate->uncertainty) << ppm;
    }
}

TEST(ClockSync, NeverStepsOnceItHasSettled)
{
    ClockSync clock;
    Path path;
    path.queue = 30ms;
    path.play(clock, ClockSync::settles_within);
    base::Duration before = clock.estimate()->offset;
    path.play(clock, 60s, [&](base::Duration) {
        const base::Duration now = clock.estimate()->offset;
        // Echoes are 10 ms apart, and arrive as far apart as queues make them.
        ASSERT_LE(std::chrono::abs(now - before), 200us);
        before = now;
    });
    EXPECT_EQ(clock.jumps(), 0U);
}

TEST(ClockSync, StepsOnceWhenTheOtherClockJumps)
{
    for (const base::Duration jump :
         {base::Duration{3h}, base::Duration{-200ms}, base::Duration{120ms}}) {
        ClockSync clock;
        Path path;
        path.queue = 2ms;
        path.ahead = [jump](base::Duration at) {
            return at < 20s ? base::Duration{5s} : 5s + jump;
        };
        path.play(clock, 20s);
        path.play(clock, 12s);
        EXPECT_EQ(clock.jumps(), 1U) << ms(jump);
        EXPECT_FALSE(clock.is_in_doubt());
        EXPECT_LT(std::abs(ms(clock.estimate()->offset - (5s + jump))), 3.0) << ms(jump);
    }
}

TEST(ClockSync, IsInDoubtAfterAJumpUntilEightSamplesAgree)
{
    ClockSync clock;
    Path path;
    path.ahead = [](base::Duration at) {
        return at < 20s ? base::Duration{5s} : base::Duration{9s};
    };
    path.play(clock, 20s);
    int doubtful = 0;
    path.play(clock, 12s, [&](base::Duration) { doubtful += clock.is_in_doubt() ? 1 : 0; });
    EXPECT_EQ(doubtful, static_cast<int>(ClockSync::samples_after_jump) - 1);
}

TEST(ClockSync, TakesNoShortDisturbanceForAJump)
{
    ClockSync clock;
    Path path;
    path.ahead = [](base::Duration at) {
        return at > 20s && at < 26s ? base::Duration{6s} : base::Duration{5s};
    };
    path.play(clock, 60s);
    EXPECT_EQ(clock.jumps(), 0U);
    EXPECT_LT(std::abs(ms(clock.estimate()->offset - 5s)), 5.0);
}

TEST(ClockSync, IsOneClockOnOneMachine)
{
    ClockSync clock;
    clock.set_same_clock();
    clock.add(sample(start, 300ms, 100ms, 0s));
    EXPECT_EQ(clock.estimate()->offset, 0s);
    EXPECT_EQ(clock.estimate()->uncertainty, 0s);
}

TEST(ClockSync, IsUnknownAgainAfterAReset)
{
    ClockSync clock;
    clock.add(sample(start, 10ms, 10ms, 1s));
    clock.reset();
    EXPECT_FALSE(clock.estimate());
}

} // namespace hapnet::peer::clock_sync_test
