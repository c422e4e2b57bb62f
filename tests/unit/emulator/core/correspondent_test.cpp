// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/correspondent.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::emulator::correspondent_test {

namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{1h};
constexpr int alice = 1;
constexpr int bob = 2;

} // namespace

TEST(Correspondent, WhenConfiguredNeverChanges)
{
    Correspondent<int> correspondent{alice};
    EXPECT_EQ(correspondent.judge(bob, start), Sender::stranger);
    EXPECT_EQ(correspondent.judge(alice, start), Sender::known);
    EXPECT_EQ(correspondent.judge(bob, start + 24h), Sender::stranger);
    EXPECT_EQ(correspondent.address(), alice);
}

TEST(Correspondent, AdoptsTheFirstSender)
{
    Correspondent<int> correspondent{std::nullopt};
    EXPECT_FALSE(correspondent.address());
    EXPECT_EQ(correspondent.judge(alice, start), Sender::adopted);
    EXPECT_EQ(correspondent.judge(alice, start), Sender::known);
    EXPECT_EQ(correspondent.address(), alice);
}

TEST(Correspondent, KeepsAnAdoptedSenderThatSpeaks)
{
    Correspondent<int> correspondent{std::nullopt};
    EXPECT_EQ(correspondent.judge(alice, start), Sender::adopted);
    for (int i = 1; i < 100; ++i) {
        const auto now = start + i * 900ms;
        EXPECT_EQ(correspondent.judge(bob, now), Sender::stranger);
        EXPECT_EQ(correspondent.judge(alice, now), Sender::known);
    }
}

TEST(Correspondent, GivesTheSeatOfASilentSenderToTheNextAndNotANanosecondEarlier)
{
    Correspondent<int> correspondent{std::nullopt};
    EXPECT_EQ(correspondent.judge(alice, start), Sender::adopted);
    EXPECT_EQ(correspondent.judge(bob, start + 1s - 1ns), Sender::stranger);
    EXPECT_EQ(correspondent.judge(bob, start + 1s), Sender::adopted);
    EXPECT_EQ(correspondent.judge(alice, start + 1s), Sender::stranger);
}

TEST(Correspondent, WelcomesASilentSenderBackWhenNobodyTookItsSeat)
{
    Correspondent<int> correspondent{std::nullopt};
    EXPECT_EQ(correspondent.judge(alice, start), Sender::adopted);
    EXPECT_EQ(correspondent.judge(alice, start + 1h), Sender::known);
}

} // namespace hapnet::emulator::correspondent_test
