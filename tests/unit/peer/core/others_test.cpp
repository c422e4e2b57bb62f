// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/others.hpp"

#include "tests/unit/peer/core/group.hpp"

#include <gtest/gtest.h>
#include <set>

namespace hapnet::peer {
namespace {

void expect_one_start(const Group& group, base::Duration at_most_apart)
{
    const Session& first = *group.peers.front()->session();
    for (const auto& peer : group.peers) {
        ASSERT_TRUE(peer->session());
        EXPECT_LE(std::chrono::abs(peer->session()->start - first.start), at_most_apart);
        EXPECT_EQ(peer->session()->seed, first.seed);
        EXPECT_EQ(peer->length(), group.peers.front()->length());
    }
}

TEST(Others, StartsAllAtTheSameTimeOneSecondAfterTheLastOneCame)
{
    for (const std::size_t size : {2U, 3U, 5U, 8U}) {
        Group group{size};
        for (std::size_t side = 0; side + 1 < size; ++side) group.start(side);
        group.run_for(3s);
        for (std::size_t side = 0; side + 1 < size; ++side) {
            EXPECT_FALSE(group.peers[side]->session()) << size;
        }
        group.start(size - 1);
        const auto came = group.now;
        group.run_for(1500ms);
        ASSERT_TRUE(group.all_play()) << size;
        expect_one_start(group, 1us);
        const auto start = group.peers[0]->session()->start;
        EXPECT_GE(start, came + 1s);
        EXPECT_LE(start, came + 1100ms);
        for (std::size_t side = 0; side < size; ++side) {
            EXPECT_TRUE(group.told(side, Event::agreed));
            EXPECT_TRUE(group.told(side, Event::started));
            EXPECT_EQ(group.peers[side]->rank(), side);
        }
    }
}

TEST(Others, TakesTheSeedOfTheLowestIdAndTheShortestLength)
{
    Group group{3};
    for (std::size_t side = 0; side < 3; ++side) {
        Settings settings = group.settings_of_group(side);
        settings.introduction.seed = 70 + side;
        settings.length = std::array<base::Duration, 3>{20s, 9s, 12s}[side];
        group.start(side, settings);
    }
    group.run_for(2s);
    ASSERT_TRUE(group.all_play());
    for (const auto& peer : group.peers) {
        EXPECT_EQ(peer->session()->seed, 70U);
        EXPECT_EQ(peer->length(), 9s);
    }
}

TEST(Others, DoesNotStartWhileTwoOfItDoNotHearEachOther)
{
    Group group{3};
    group.cut(1, 2, true);
    group.start_all();
    group.run_for(5s);
    for (const auto& peer : group.peers) EXPECT_FALSE(peer->session());
    group.cut(1, 2, false);
    group.run_for(2s);
    EXPECT_TRUE(group.all_play());
}

TEST(Others, StartsWithAsManyAsAreWaitedForAndLetsTheOthersJoin)
{
    Group group{3};
    for (const std::size_t side : {0U, 1U}) {
        Settings settings = group.settings_of_group(side);
        settings.roster.wait_for = 2;
        group.start(side, settings);
    }
    group.run_for(3s);
    ASSERT_TRUE(group.peers[0]->session());
    group.start(2);
    group.run_for(500ms);
    ASSERT_TRUE(group.all_play());
    expect_one_start(group, 1us);
    EXPECT_TRUE(group.told(2, Event::joined));
    EXPECT_FALSE(group.told(2, Event::started));
}

TEST(Others, LetsAnyOfItBeRestartedAlsoTheOneThatSetTheStart)
{
    for (const std::size_t side : {0U, 1U, 2U}) {
        Group group{3};
        group.start_all();
        group.run_for(3s);
        const auto start = group.peers[1]->session()->start;
        group.kill(side);
        group.run_for(2s);
        group.start(side);
        group.run_for(500ms);
        ASSERT_TRUE(group.all_play()) << side;
        EXPECT_TRUE(group.told(side, Event::joined));
        EXPECT_LE(std::chrono::abs(group.peers[side]->session()->start - start), 1us);
        for (const std::size_t other : {0U, 1U, 2U}) {
            if (other == side) continue;
            const auto id = static_cast<std::uint16_t>(side + 1);
            EXPECT_TRUE(group.told(other, Event::lost, id));
            EXPECT_TRUE(group.told(other, Event::restarted, id));
        }
    }
}

TEST(Others, ThatBeganApartFromAnotherBecomesOneWithItWhereTheEarlierStartCounts)
{
    for (const bool lower_ids_come_first : {true, false}) {
        Group group{4};
        for (const std::size_t a : {0U, 1U})
            for (const std::size_t b : {2U, 3U}) group.cut(a, b, true);
        const auto start = [&](std::size_t side) {
            Settings settings = group.settings_of_group(side);
            settings.roster.wait_for = 2;
            settings.introduction.seed = 70 + side;
            group.start(side, settings);
        };
        const std::size_t first = lower_ids_come_first ? 0 : 2, last = 2 - first;
        start(first);
        start(first + 1);
        group.run_for(3s);
        const auto earlier = group.peers[first]->session()->start;
        start(last);
        start(last + 1);
        group.run_for(3s);
        ASSERT_TRUE(group.peers[last]->session());
        EXPECT_GE(group.peers[last]->session()->start, earlier + 2s);
        for (const std::size_t a : {0U, 1U})
            for (const std::size_t b : {2U, 3U}) group.cut(a, b, false);
        group.run_for(500ms);
        ASSERT_TRUE(group.all_play());
        expect_one_start(group, 1us);
        EXPECT_LE(std::chrono::abs(group.peers[0]->session()->start - earlier), 1us);
        EXPECT_EQ(group.peers[0]->session()->seed, 70 + first);
        // All know it now, so no further message mentions it.
        const auto hellos = group.peers[0]->counters().hellos;
        group.run_for(2s);
        EXPECT_EQ(group.peers[0]->counters().hellos, hellos);
        group.run_for(30s);
        for (const auto& peer : group.peers) EXPECT_TRUE(peer->finished());
    }
}

TEST(Others, HasEveryPairNumberItsMessagesForItself)
{
    Group group{3};
    group.start_all();
    group.run_for(3s);
    std::set<std::uint32_t> numbers;
    for (const auto& peer : group.peers)
        for (const Remote& other : peer->others()) numbers.insert(other.numbering().number);
    EXPECT_EQ(numbers.size(), 3U); // one for each pair
}

TEST(Others, EndsTogetherAndSaysGoodbyeToAll)
{
    Group group{3};
    for (std::size_t side = 0; side < 3; ++side) {
        Settings settings = group.settings_of_group(side);
        settings.length = 2s;
        group.start(side, settings);
    }
    group.run_for(3500ms);
    for (std::size_t side = 0; side < 3; ++side) {
        EXPECT_TRUE(group.peers[side]->finished());
        EXPECT_TRUE(group.told(side, Event::ended));
    }
}

TEST(Others, PlaysOnWhenOneOfItLeaves)
{
    Group group{3};
    group.start_all();
    group.run_for(3s);
    group.peers[0]->leave(wire::ByeReason::interrupted);
    group.run_for(1s);
    for (const std::size_t side : {1U, 2U}) {
        EXPECT_TRUE(group.told(side, Event::left, 1));
        EXPECT_EQ(group.ticks[side].phase, Phase::running);
        EXPECT_TRUE(group.ticks[side].permitted);
    }
}

TEST(Others, ListensToNobodyElseInOnesPlace)
{
    Group group{3};
    group.start_all();
    group.run_for(3s);
    const auto before = group.peers[0]->counters().other_session;
    Peer stranger{group.settings_of_group(2)};
    std::ignore = stranger.tick(group.now, {});
    group.peers[0]->on_datagram(stranger.poll(0)->bytes(), group.now,
                                0); // 3 as if it were 2
    EXPECT_EQ(group.peers[0]->counters().other_session, before + 1);
    EXPECT_EQ(group.peers[0]->others()[0].id(), 2);
}

} // namespace
} // namespace hapnet::peer
