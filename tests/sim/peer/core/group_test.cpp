// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// More than two peers with one cube, over bad networks drawn from a seed.
#include "tests/support/seeds.hpp"
#include "tests/unit/peer/core/group.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

namespace hapnet::peer {
namespace {

constexpr base::Duration length = 12s; // 9 s hands on
constexpr double limit_n = 3.3;

/// The hands take the cube between them and carry it to and fro: the 1st, 3rd, ... from the left,
/// the others from the right. They let go with the session's hands off.
Hand carry(std::size_t side, base::Duration since_start)
{
    if (since_start >= length - Peer::hands_off_length)
        return {.hip = {{0.0, 0.2, 0.0}}, .velocity = {}};
    constexpr double reach_m = 0.01, speed_rad_s = 2.0, squeeze_m = 0.001;
    const double t = base::to_seconds(since_start);
    const double centre = reach_m * std::sin(speed_rad_s * t);
    const double sign = side % 2 == 0 ? -1.0 : 1.0;
    return {.hip = {{centre + sign * (0.025 - squeeze_m), 0.0, 0.0}},
            .velocity = {{reach_m * speed_rad_s * std::cos(speed_rad_s * t), 0.0, 0.0}}};
}

Settings settings_for(Group& group, std::size_t side)
{
    Settings settings = group.settings_of_group(side);
    settings.scene.hands.count = peers_max;
    settings.introduction.scene_hash = hash(settings.scene);
    settings.length = length;
    return settings;
}

Group group_of(std::size_t size, base::Seed seed, const Group::Path& path)
{
    Group group{size, seed};
    std::ranges::fill(group.paths, path);
    group.move = carry;
    for (std::size_t side = 0; side < size; ++side) group.start(side, settings_for(group, side));
    return group;
}

void expect_sound(const Group& group)
{
    for (std::size_t side = 0; side < group.peers.size(); ++side) {
        if (!group.peers[side]) continue;
        const Tick& tick = group.ticks[side];
        ASSERT_TRUE(base::is_finite(tick.force));
        ASSERT_LE(base::norm(tick.force), limit_n + 1e-9);
        ASSERT_TRUE(base::is_finite(group.peers[side]->body().position));
        ASSERT_LE(std::abs(group.peers[side]->position().x()), 0.2);
        const Counters& counters = group.peers[side]->counters();
        ASSERT_EQ(counters.malformed + counters.implausible + counters.unusable_hand, 0U);
    }
}

void run_to(Group& group, base::TimePoint end)
{
    while (group.now < end) {
        group.step();
        expect_sound(group);
        if (testing::Test::HasFatalFailure()) return;
    }
}

/// The end of the hands-off phase, minus `before`.
base::TimePoint end_of(const Group& group, base::Duration before)
{
    return group.peers.front()->session()->start + length - before;
}

TEST(Group, CarriesACubeTogetherAndAgreesWhereItIsInTheEnd)
{
    for (const std::size_t size : {2U, 3U, 5U, 8U}) {
        Group group =
            group_of(size, base::Seed{size}, {.delay = 30ms, .spread_us = 20'000, .loss = 0.3});
        run_to(group, group.now + 5s);
        ASSERT_TRUE(group.all_play()) << size;
        double farthest = 0.0;
        for (int ms = 0; ms < 4000; ++ms) {
            group.step();
            farthest = std::max(farthest, std::abs(group.peers.back()->position().x()));
        }
        EXPECT_GT(farthest, 0.005) << size; // the cube is carried
        run_to(group, end_of(group, 1s));
        EXPECT_LE(group.apart_m(), 0.1e-3) << size;
    }
}

TEST(Group, FeelsNothingOfADeadHandAfter300MsAndPlaysOnAfterASecond)
{
    for (const std::size_t victim : {0U, 1U, 2U}) {
        Group group = group_of(3, base::Seed{9}, {.delay = 40ms});
        run_to(group, group.now + 3s);
        ASSERT_TRUE(group.all_play());
        group.kill(victim);
        const auto killed = group.now;
        // Its last datagram takes 40 ms. Then its last state holds for 250 ms and fades.
        run_to(group, killed + 40ms + 300ms);
        for (std::size_t side = 0; side < 3; ++side) {
            if (side == victim) continue;
            const std::size_t place = victim < side ? victim : victim - 1;
            EXPECT_EQ(group.peers[side]->others()[place].freshness_at(group.now), 0.0);
        }
        while (group.now < killed + 1s) {
            group.step();
            for (std::size_t side = 0; side < 3; ++side) {
                EXPECT_TRUE(side == victim || !group.ticks[side].permitted);
            }
        }
        run_to(group, killed + 1100ms);
        for (std::size_t side = 0; side < 3; ++side) {
            EXPECT_TRUE(side == victim || group.ticks[side].permitted) << side << victim;
        }
    }
}

TEST(Group, DoesNotHoldTheOthersUpWhenAHandThatTouchedNothingDies)
{
    Group group = group_of(3, base::Seed{9}, {});
    group.move = [](std::size_t side, base::Duration since_start) {
        return side == 2 ? Hand{.hip = {{0.0, 0.2, 0.0}}, .velocity = {}}
                         : carry(side, since_start);
    };
    run_to(group, group.now + 3s);
    ASSERT_TRUE(group.all_play());
    group.kill(2);
    for (int ms = 0; ms < 2000; ++ms) {
        group.step();
        EXPECT_TRUE(group.ticks[0].permitted);
        EXPECT_TRUE(group.ticks[1].permitted);
    }
}

TEST(Group, OfTwoHandsThatPushTheSameWayIsFeltAsTheirSum)
{
    Group group = group_of(3, base::Seed{2}, {});
    group.move = [](std::size_t side, base::Duration) {
        const double sign = side == 0 ? -1.0 : 1.0; // one from the left, two from the right
        return Hand{.hip = {{sign * 0.024, 0.0, 0.0}}, .velocity = {}};
    };
    run_to(group, group.now + 6s);
    ASSERT_TRUE(group.all_play());
    // In balance the push of the one hand equals the push of the two together.
    const double one = group.ticks[0].touched.on_body.x();
    const double two = group.ticks[1].touched.on_body.x() + group.ticks[2].touched.on_body.x();
    EXPECT_GT(one, 0.1);
    EXPECT_NEAR(one, -two, 1e-3 * one);
    EXPECT_NEAR(group.ticks[0].remote_force.x(), two, 1e-3 * one);
}

class Groups : public testing::TestWithParam<std::uint64_t> {};

/// Anything may happen until three seconds before the hands let go; then the network heals.
TEST_P(Groups, OfAnySizeAgreeInTheEndWhateverHappened)
{
    const base::Seed seed{GetParam()};
    const auto draw = seed.stream("group conditions");
    const std::size_t size = 2 + draw.below(4, 0);
    Group group{size, seed};
    group.move = carry;
    for (std::uint32_t i = 0; i < group.paths.size(); ++i)
        group.paths[i] = {.delay = base::from_seconds(0.15 * draw.uniform(1, i)),
                          .spread_us = 1 + static_cast<std::uint32_t>(draw.below(50'000, 2, i)),
                          .loss = 0.6 * draw.uniform(3, i)};
    for (std::size_t side = 0; side < size; ++side) group.start(side, settings_for(group, side));
    for (int ms = 0; ms < 20'000 && !group.all_play(); ++ms) group.step();
    ASSERT_TRUE(group.all_play());
    base::TimePoint start = group.peers.front()->session()->start;
    for (std::uint32_t trouble = 0; trouble < 6; ++trouble) {
        const std::size_t side = draw.below(static_cast<std::uint32_t>(size), 4, trouble);
        const auto for_so_long = base::from_seconds(0.1 + 1.5 * draw.uniform(5, trouble));
        const bool dies = draw.below(2, 6, trouble) == 0;
        if (group.now > start + 6s) break;
        if (dies) group.kill(side);
        group.isolate(side, true);
        run_to(group, group.now + for_so_long);
        ASSERT_FALSE(HasFatalFailure());
        group.isolate(side, false);
        if (dies) group.start(side, settings_for(group, side));
    }
    // When the last peer that knew a session died, those that came meanwhile begin another.
    for (int ms = 0; ms < 3000 && !group.all_play(); ++ms) group.step();
    ASSERT_TRUE(group.all_play()) << size;
    start = group.peers.front()->session()->start;
    run_to(group, start + length - 500ms);
    ASSERT_FALSE(HasFatalFailure());
    EXPECT_LE(group.apart_m(), 0.1e-3) << size;
    run_to(group, start + length + 500ms);
    for (const auto& peer : group.peers) EXPECT_TRUE(peer->finished()) << size;
}

INSTANTIATE_TEST_SUITE_P(Seed, Groups, testing::Range(std::uint64_t{0}, test::seeds(20)));
INSTANTIATE_TEST_SUITE_P(All, Groups, testing::Range(test::seeds(20), std::uint64_t{50}));

/// Beyond 20 ms and four times half of a round trip, of at most 70 ms each way, starts differ.
constexpr base::Duration one_start_within = 20ms + 4 * 70ms;

/// The largest difference between the starts of all peers.
base::Duration starts_apart(const Group& group)
{
    const auto starts = std::minmax_element(
        group.peers.begin(), group.peers.end(),
        [](const auto& a, const auto& b) { return a->session()->start < b->session()->start; });
    return (*starts.second)->session()->start - (*starts.first)->session()->start;
}

/// Four to six peers in two halves, drawn from a seed, that cannot hear each other.
struct Partition {
    explicit Partition(base::Seed seed);

    void cut(bool is_cut)
    {
        for (std::size_t a = 0; a < half; ++a)
            for (std::size_t b = half; b < order.size(); ++b) group.cut(order[a], order[b], is_cut);
    }
    /// Starts the peers at these places of the order, each waiting for one other.
    void start(std::size_t from, std::size_t to)
    {
        for (std::size_t i = from; i < to; ++i) {
            Settings settings = settings_for(group, order[i]);
            settings.roster.wait_for = 2;
            group.start(order[i], settings);
        }
    }

    base::RandomStream draw;
    Group group;
    std::vector<std::size_t> order; // the first `half` of it, at least two, and the others likewise
    std::size_t half;
};

Partition::Partition(base::Seed seed)
    : draw{seed.stream("partition")},
      group{4 + draw.below(3, 0), seed},
      order(group.peers.size()),
      half{2 + draw.below(static_cast<std::uint32_t>(order.size()) - 3, 5)}
{
    group.move = carry;
    for (std::uint32_t i = 0; i < group.paths.size(); ++i)
        group.paths[i] = {.delay = base::from_seconds(0.05 * draw.uniform(1, i)),
                          .spread_us = 1 + static_cast<std::uint32_t>(draw.below(20'000, 2, i)),
                          .loss = 0.3 * draw.uniform(3, i)};
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::uint32_t i = 0; i < order.size(); ++i) {
        const auto left = static_cast<std::uint32_t>(order.size()) - i;
        std::swap(order[i], order[i + draw.below(left, 4, i)]);
    }
    cut(true);
}

class Partitions : public testing::TestWithParam<std::uint64_t> {};

/// One half comes later than the other. When the network heals, before the hands of the first let
/// go, they become one session.
TEST_P(Partitions, ThatBeganBeforeTheStartEndAsOneSession)
{
    Partition partition{base::Seed{GetParam()}};
    auto& [draw, group, order, half] = partition;
    partition.start(0, half);
    run_to(group, group.now + base::from_seconds(2.0 * draw.uniform(6)));
    partition.start(half, order.size());
    const auto all_agreed = [&group = group] {
        return std::ranges::all_of(group.peers,
                                   [](const auto& peer) { return peer->session().has_value(); });
    };
    for (int ms = 0; ms < 5000 && !all_agreed(); ++ms) group.step();
    ASSERT_TRUE(all_agreed());
    run_to(group, group.now + base::from_seconds(3.0 * draw.uniform(7)));
    std::vector<base::TimePoint> before;
    for (const auto& peer : group.peers) before.push_back(peer->session()->start);
    const base::TimePoint earliest = *std::ranges::min_element(before);
    partition.cut(false);
    run_to(group, group.now + 2s);
    ASSERT_FALSE(HasFatalFailure());
    ASSERT_TRUE(group.all_play());
    EXPECT_LE(starts_apart(group), one_start_within);
    for (std::size_t side = 0; side < before.size(); ++side) {
        const base::TimePoint start = group.peers[side]->session()->start;
        EXPECT_LE(std::chrono::abs(start - earliest), one_start_within);
        EXPECT_LE(start, before[side]); // it never goes back
    }
    run_to(group, earliest + length - 500ms);
    ASSERT_FALSE(HasFatalFailure());
    EXPECT_LE(group.apart_m(), 0.1e-3);
    run_to(group, earliest + length + 500ms);
    for (const auto& peer : group.peers) EXPECT_TRUE(peer->finished());
}

INSTANTIATE_TEST_SUITE_P(Seed, Partitions, testing::Range(std::uint64_t{0}, test::seeds(10)));
INSTANTIATE_TEST_SUITE_P(All, Partitions, testing::Range(test::seeds(10), std::uint64_t{25}));

} // namespace
} // namespace hapnet::peer
