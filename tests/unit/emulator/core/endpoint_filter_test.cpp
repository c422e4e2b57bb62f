// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/endpoint_filter.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::emulator::endpoint_filter_test {

namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{1h};
constexpr int alice = 1;
constexpr int bob = 2;

} // namespace

TEST(EndpointFilter, WhenConfiguredNeverChanges)
{
    EndpointFilter<int> filter{alice};
    EXPECT_EQ(filter.classify(bob, start), Sender::unknown);
    EXPECT_EQ(filter.classify(alice, start), Sender::known);
    EXPECT_EQ(filter.classify(bob, start + 24h), Sender::unknown);
    EXPECT_EQ(filter.address(), alice);
}

TEST(EndpointFilter, AdoptsTheFirstSender)
{
    EndpointFilter<int> filter{std::nullopt};
    EXPECT_FALSE(filter.address());
    EXPECT_EQ(filter.classify(alice, start), Sender::adopted);
    EXPECT_EQ(filter.classify(alice, start), Sender::known);
    EXPECT_EQ(filter.address(), alice);
}

TEST(EndpointFilter, KeepsAnAdoptedSenderThatSpeaks)
{
    EndpointFilter<int> filter{std::nullopt};
    EXPECT_EQ(filter.classify(alice, start), Sender::adopted);
    for (int i = 1; i < 100; ++i) {
        const auto now = start + i * 900ms;
        EXPECT_EQ(filter.classify(bob, now), Sender::unknown);
        EXPECT_EQ(filter.classify(alice, now), Sender::known);
    }
}

TEST(EndpointFilter, GivesTheSeatOfASilentSenderToTheNextAndNotANanosecondEarlier)
{
    EndpointFilter<int> filter{std::nullopt};
    EXPECT_EQ(filter.classify(alice, start), Sender::adopted);
    EXPECT_EQ(filter.classify(bob, start + 1s - 1ns), Sender::unknown);
    EXPECT_EQ(filter.classify(bob, start + 1s), Sender::adopted);
    EXPECT_EQ(filter.classify(alice, start + 1s), Sender::unknown);
}

TEST(EndpointFilter, WelcomesASilentSenderBackWhenNobodyTookItsSeat)
{
    EndpointFilter<int> filter{std::nullopt};
    EXPECT_EQ(filter.classify(alice, start), Sender::adopted);
    EXPECT_EQ(filter.classify(alice, start + 1h), Sender::known);
}

} // namespace hapnet::emulator::endpoint_filter_test
