// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/playout.hpp"

#include "proto/base/random.hpp"
#include "tests/unit/peer/core/pair.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <map>
#include <vector>

namespace hapnet::peer::playout_test {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{100s};

wire::State state_of(std::uint32_t sequence, base::Duration clock_ahead = {})
{
    wire::State state;
    state.sequence = sequence;
    state.sent = start + sequence * 1ms + clock_ahead;
    return state;
}

/// A path of 1000 states a second into a buffer that is read every millisecond.
struct Path {
    PlayoutBuffer buffer;
    std::multimap<base::TimePoint, wire::State> on_their_way;
    std::vector<PlayoutBuffer::Played> played;
    std::vector<base::Duration> transits; // of all, in the order of arrival
    std::size_t late = 0;
    std::uint32_t sequence = 0;

    void send(base::Duration transit, base::Duration clock_ahead = {})
    {
        ++sequence;
        const base::TimePoint now = start + sequence * 1ms;
        on_their_way.emplace(now + transit, state_of(sequence, clock_ahead));
        while (!on_their_way.empty() && on_their_way.begin()->first <= now) {
            const auto& [arrived, state] = *on_their_way.begin();
            transits.push_back(arrived - state.sent);
            if (!buffer.put(state, arrived)) ++late;
            on_their_way.erase(on_their_way.begin());
        }
        while (auto next = buffer.next(now)) played.push_back(*next);
    }
};

/// 25 to 55 ms, by chance.
base::Duration swinging(std::uint32_t number)
{
    static const auto draws = base::Seed{7}.stream("transits");
    return 25ms + base::Duration{static_cast<base::Duration::rep>(draws.bits(number) % 30'000'000)};
}

TEST(PlayoutBuffer, PlaysAtOnceWhatComesEvenly)
{
    Path path;
    for (int i = 0; i < 3000; ++i) path.send(40ms);
    ASSERT_EQ(path.played.size(), 2960U);
    for (const auto& played : path.played) EXPECT_EQ(played.at, played.state.sent + 40ms);
    EXPECT_EQ(path.late, 0U);
    EXPECT_EQ(path.buffer.transit(), 40ms);
}

TEST(PlayoutBuffer, PlaysInOrderAndEvenlyWhatSwings)
{
    Path path;
    for (std::uint32_t i = 0; i < 20'000; ++i) path.send(swinging(i));
    std::size_t uneven = 0;
    std::size_t disordered = 0;
    for (std::size_t i = 2000; i < path.played.size(); ++i) {
        const auto& [before, before_at] = path.played[i - 1];
        const auto& [state, at] = path.played[i];
        if (state.sequence < before.sequence) ++disordered;
        const base::Duration ipdv = (at - state.sent) - (before_at - before.sent);
        if (ipdv < -200us || ipdv > 200us) ++uneven;
    }
    // A late state, 1 in 100, makes a change, and so does the next.
    EXPECT_LE(uneven, path.played.size() * 3 / 100);
    EXPECT_LE(disordered, path.played.size() * 15 / 1000);
    EXPECT_LE(path.late, path.played.size() * 15 / 1000);
    EXPECT_GT(path.buffer.transit(), 54ms);
    EXPECT_LE(path.buffer.transit(), 55ms);
}

TEST(PlayoutBuffer, HasATransitThatAllButOneInAHundredKeep)
{
    Path path;
    for (std::uint32_t i = 0; i < 12'000; ++i) {
        path.send(swinging(i) + (i % 3000 < 1500 ? 0ms : 20ms));
        if (i % 97 != 0 || path.transits.empty()) continue;
        const std::size_t seen = std::min(path.transits.size(), PlayoutBuffer::window);
        const auto longer = std::count_if(
            path.transits.end() - static_cast<std::ptrdiff_t>(seen), path.transits.end(),
            [&](base::Duration one) { return one > *path.buffer.transit() + PlayoutBuffer::step; });
        EXPECT_LE(static_cast<double>(longer), 0.01 * static_cast<double>(seen)) << i;
    }
}

TEST(PlayoutBuffer, GrowsAtOnceAndShrinksByOnePercentOfTheTime)
{
    Path path;
    for (int i = 0; i < 2000; ++i) path.send(20ms);
    for (int i = 0; i < 200; ++i) path.send(60ms);
    EXPECT_GE(path.buffer.transit(), 60ms - PlayoutBuffer::step);
    for (int i = 0; i < 2500; ++i) path.send(20ms); // the window forgets the slower ones
    auto before = path.buffer.transit();
    for (int i = 0; i < 5000; ++i) {
        path.send(20ms);
        EXPECT_LE(*path.buffer.transit(), *before);
        EXPECT_LE(*before - *path.buffer.transit(), 10us);
        before = path.buffer.transit();
    }
    EXPECT_EQ(path.buffer.transit(), 20ms);
}

TEST(PlayoutBuffer, HoldsNoStateLongerThanItsBoundAndNotMoreThanItsRoom)
{
    Path path;
    for (std::uint32_t i = 0; i < 4000; ++i) path.send(i % 50 == 0 ? 390ms : 5ms);
    for (const auto& played : path.played)
        EXPECT_LE(played.at - played.state.sent, 5ms + PlayoutBuffer::wait_max + 390ms);

    PlayoutBuffer full;
    full.put(state_of(1000), start);
    for (std::uint32_t sequence = 1; sequence < 1000; ++sequence)
        full.put(state_of(sequence), start + 500ms);
    std::size_t played = 0;
    while (full.next(start + 10s)) ++played;
    EXPECT_EQ(played, PlayoutBuffer::waiting_max);
}

TEST(PlayoutBuffer, FollowsAClockThatJumps)
{
    for (const base::Duration jump : {base::Duration{10s}, base::Duration{-10s}}) {
        Path path;
        for (int i = 0; i < 1000; ++i) path.send(40ms);
        for (int i = 0; i < 3000; ++i) path.send(40ms, jump);
        const auto& [state, at] = path.played.back();
        EXPECT_LE(at - (start + state.sequence * 1ms), 50ms);
        EXPECT_GE(path.played.size(), 3900U);
    }
}

TEST(PlayoutBuffer, ForgetsWhatWaitsAndThePath)
{
    PlayoutBuffer buffer;
    buffer.put(state_of(1), start + 50ms);
    buffer.forget();
    EXPECT_EQ(buffer.transit(), std::nullopt);
    EXPECT_FALSE(buffer.next(start + 10s));
}

TEST(PeerWithPlayout, HearsEveryStateAsOneWithout)
{
    Pair pair;
    for (const std::size_t side : {0U, 1U}) {
        Settings settings = settings_of(side);
        if (side == 0) settings.playout = Playout::adaptive;
        pair.start(side, settings);
    }
    pair.run_until_started();
    pair.hands[0] = pushing(0.004);
    pair.run_for(2s);
    const Counters& with = pair.peers[0]->counters();
    const Counters& without = pair.peers[1]->counters();
    EXPECT_NEAR(static_cast<double>(with.states), static_cast<double>(without.states), 2.0);
    EXPECT_EQ(with.outdated, 0U);
    EXPECT_EQ(with.played_late, 0U);
    EXPECT_TRUE(pair.ticks[0].permitted);
    EXPECT_FALSE(pair.told(0, Event::lost));
}

} // namespace
} // namespace hapnet::peer::playout_test
