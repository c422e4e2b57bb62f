// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Sessions under an attacker who owns the path, on networks as bad as they come.
#include "tests/support/seeds.hpp"
#include "tests/support/session/attacked_session.hpp"

#include <gtest/gtest.h>

namespace hapnet::test {
namespace {

void expect_to_hold(std::uint64_t seed, Seal seal, std::size_t peers = 2)
{
    const AttackedSession session = play_attacked(seed, seal, peers);
    EXPECT_FALSE(session.complaint)
        << *session.complaint << "\nrepeat it: build/release/bin/soak_session " << name_of(seal)
        << " " << seed << " 1 --peers " << peers;
    EXPECT_GT(session.datagrams, 0U);
}

class Mallory : public testing::TestWithParam<std::uint64_t> {};
TEST_P(Mallory, BringsNoForceBeyondItsLimits) { expect_to_hold(GetParam(), Seal::none); }
INSTANTIATE_TEST_SUITE_P(Seed, Mallory, testing::Range(std::uint64_t{0}, test::seeds(50)));

class MalloryWithoutKey : public testing::TestWithParam<std::uint64_t> {};
TEST_P(MalloryWithoutKey, HasNothingAcceptedThatTheOtherSideHasNotSealed)
{
    expect_to_hold(GetParam(), Seal::keys);
    expect_to_hold(GetParam(), Seal::own);
}
INSTANTIATE_TEST_SUITE_P(Seed, MalloryWithoutKey,
                         testing::Range(std::uint64_t{0}, test::seeds(30)));

/// On all links of three to five, of which each seed plays one.
class MalloryAmongMany : public testing::TestWithParam<std::uint64_t> {};
TEST_P(MalloryAmongMany, BringsNoForceBeyondItsLimits)
{
    expect_to_hold(GetParam(), Seal::none, 3 + GetParam() % 3);
}
TEST_P(MalloryAmongMany, WithoutKeyHasNothingAcceptedThatTheOthersHaveNotSealed)
{
    expect_to_hold(GetParam(), Seal::keys, 3 + GetParam() % 3);
}
INSTANTIATE_TEST_SUITE_P(Seed, MalloryAmongMany, testing::Range(std::uint64_t{0}, test::seeds(3)));
INSTANTIATE_TEST_SUITE_P(All, MalloryAmongMany, testing::Range(test::seeds(3), std::uint64_t{10}));

// Both sides were started again with their dates hours back, and each took an initiation of the
// other's former run, of a later date: they shut each other out for those hours.
TEST(MalloryWithRecordedInitiations, KeepsTwoApartNoLongerThanHeIsThereThoughTheirDatesWentBack)
{
    for (const std::uint64_t seed : {900'315U, 900'485U}) expect_to_hold(seed, Seal::keys);
}

// What a run that had ended still had on its way took the other side back into a session that
// nobody was in any more.
TEST(MalloryWithMessagesOfAFormerRun, KeepsNobodyInItsSession)
{
    expect_to_hold(5'001'246, Seal::keys);
}

// All hands were off, and the waves of copies that were put after the leader's drove that one on.
TEST(MalloryAmongWaves, LeavesABodyThatComesToRestWhenAllHandsAreOff)
{
    expect_to_hold(12'001'225, Seal::none, 3);
    expect_to_hold(12'001'010, Seal::keys, 4);
}

// One of four came back with its date a day back, and another had just answered a recorded
// initiation: they met 11 s later.
TEST(MalloryWithRecordedInitiations, KeepsOneOfManyOutNoLongerThanTheHandshakeAllows)
{
    expect_to_hold(12'001'374, Seal::keys, 4);
}

} // namespace
} // namespace hapnet::test
