// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT

// Renewed keys on bad networks and with dates that jump, and redirected datagrams.

#include "proto/secure/association.hpp"

#include "tests/unit/proto/secure/circle.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace hapnet::secure::association_renewal_test {

namespace {

using namespace circle;

constexpr Setting one{.id = 1, .run = 11, .seed = 100};
constexpr Setting two{.id = 2, .run = 22, .seed = 200};

constexpr std::int64_t twenty_years_ns = 20 * 365 * 86'400'000'000'000;

bool is_initiation_of_the_lower_id(const Datagram& datagram)
{
    return datagram.to == 1 && frame_type_of(datagram.bytes) == FrameType::initiation;
}

/// Returns the largest number of consecutive messages that did not arrive.
std::uint32_t longest_gap(std::vector<std::uint32_t> sequences)
{
    std::ranges::sort(sequences);
    std::uint32_t longest = 0;
    for (std::size_t i = 1; i < sequences.size(); ++i)
        longest = std::max(longest, sequences[i] - sequences[i - 1] - 1);
    return longest;
}

/// Expects that every datagram was opened, or had come before, in one session.
void expect_nothing_lost(World& world)
{
    for (Side* side : {&world.a(), &world.b()}) {
        const auto& counts = side->association->counts();
        EXPECT_EQ(side->session, session_of(11, 22));
        EXPECT_EQ(counts.unknown_key + counts.forged + counts.other_circle, 0U);
        EXPECT_LE(longest_gap(side->received), 20U); // 0.3 to the power of 21: once in 10^11
    }
}

Network bad_network(std::uint64_t seed)
{
    return {.loss = 0.3, .delay = 40ms, .jitter = 30ms, .duplicates = 0.05, .seed = seed};
}

} // namespace

TEST(AssociationRenewal, LosesNoStateOverLossAndReordering)
{
    for (const std::uint64_t seed : {1U, 2U}) {
        World world{one, two, bad_network(seed)};
        world.run(1s);
        const std::uint64_t not_sealed = world.a().association->counts().not_sealed;
        world.run(124s);
        EXPECT_EQ(world.a().association->counts().not_sealed, not_sealed);
        EXPECT_EQ(world.a().association->counts().rekeys, 1U); // begun by the lower id, at 110 s
        EXPECT_EQ(world.b().association->counts().rekeys, 1U);
        expect_nothing_lost(world);
    }
}

TEST(AssociationRenewal, IsBegunByTheHigherIdWhenTheLowerOnesInitiationsNeverArrive)
{
    World world{one, two, bad_network(3)};
    world.run(1s);
    world.network().drops = is_initiation_of_the_lower_id;
    world.run(128s);
    EXPECT_EQ(world.b().association->counts().rekeys, 0U);
    world.run(6s);
    EXPECT_EQ(world.a().association->counts().rekeys, 1U);
    EXPECT_EQ(world.b().association->counts().rekeys, 1U);
    expect_nothing_lost(world);
}

TEST(AssociationRenewal, GoesOnWhereDatesJumpByYearsWithinARun)
{
    // Both dates jump forward before the first renewal, and back before the second, at 220 s.
    World world{one, two};
    world.run(100s);
    for (const std::int64_t offset : {twenty_years_ns, std::int64_t{0}}) {
        for (Side* side : {&world.a(), &world.b()}) side->unix_offset_ns = offset;
        world.run(120s);
    }
    for (Side* side : {&world.a(), &world.b()}) {
        EXPECT_EQ(side->association->counts().rekeys, 3U); // the last at 330 s
        EXPECT_EQ(side->association->counts().replayed, 0U);
        EXPECT_EQ(side->received.back() - side->received.front() + 1, side->received.size());
    }
}

TEST(AssociationRenewal, MeetsARunWhoseDateIsYearsFromTheFormerOnes)
{
    for (const std::int64_t offset : {twenty_years_ns, -twenty_years_ns}) {
        for (const int which : {0, 1}) {
            World world{one, two};
            world.run(2s);
            Setting again = which == 0 ? one : two;
            again.run = 33;
            again.seed = 201;
            Side& side = which == 0 ? world.a() : world.b();
            side = World::side(again);
            side.unix_offset_ns = offset;
            world.run(8s); // the lower id asks for 5 s before it listens
            EXPECT_GT(world.a().received.size(), 500U) << offset << ' ' << which;
            EXPECT_GT(world.b().received.size(), 500U) << offset << ' ' << which;
        }
    }
}

TEST(AssociationRedirected, MeetsOnceWhoRedirectsAllDatagramsHasLeftOrAtOnceWhenItMayNotRoam)
{
    for (const bool may_roam : {true, false}) {
        Setting a = one, b = two;
        a.may_roam = b.may_roam = may_roam;
        Network network;
        network.redirected_from = place_of(66); // where all answers end
        World world{a, b, network};
        world.run(20s);
        EXPECT_EQ(world.a().received.empty(), may_roam);
        EXPECT_EQ(world.b().received.empty(), may_roam);
        world.network().redirected_from.reset();
        world.run(7s);
        EXPECT_GT(world.a().received.size(), 900U) << may_roam;
        EXPECT_GT(world.b().received.size(), 900U) << may_roam;
    }
}

TEST(AssociationRedirected, LosesTheOtherSideForNoLongerThanAllIsRedirected)
{
    World world{one, two};
    world.run(2s);
    world.network().redirected_from = place_of(66);
    world.run(5s);
    const std::size_t a = world.a().received.size(), b = world.b().received.size();
    EXPECT_LT(a + b, 4100U);
    world.network().redirected_from.reset();
    world.run(3s);
    EXPECT_GT(world.a().received.size(), a + 500);
    EXPECT_GT(world.b().received.size(), b + 500);
}

} // namespace hapnet::secure::association_renewal_test
