// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/link.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace hapnet::emulator {

namespace {

using namespace std::chrono_literals;
using namespace base::literals; // NOLINT(google-build-using-namespace): literals only

constexpr base::TimePoint start{1h};
constexpr std::array<std::byte, 96> payload{};

/// The numbers of datagrams that arrived 1 ms apart, in the order in which they leave.
std::vector<std::uint64_t> numbers_that_leave(Order order, base::Duration jitter, int count)
{
    const base::Seed seed{7};
    Link link{Pipeline{{ConstantDelay{10ms}, UniformJitter{jitter, seed.stream("up/jitter")}}},
              order};
    for (int i = 0; i < count; ++i) link.on_packet(payload, start + i * 1ms);
    std::vector<std::uint64_t> numbers;
    while (auto datagram = link.poll(start + 1h)) {
        numbers.push_back(datagram->number);
        link.on_sent(*std::move(datagram), start + 1h);
    }
    return numbers;
}

} // namespace

TEST(Link, HoldsADatagramUntilItsDelayHasPassedAndNotANanosecondLonger)
{
    Link link{Pipeline{{ConstantDelay{160ms}}}};
    EXPECT_EQ(link.on_packet(payload, start), Verdict{Deliver{160ms}});
    EXPECT_EQ(link.next_deadline(), start + 160ms);
    EXPECT_FALSE(link.poll(start + 160ms - 1ns));
    EXPECT_TRUE(link.poll(start + 160ms));
    EXPECT_FALSE(link.next_deadline());
}

TEST(Link, ForwardsAtOnceWhenNothingIsAskedOfIt)
{
    Link link{Pipeline{}};
    EXPECT_EQ(link.on_packet(payload, start), Verdict{Deliver{0ns}});
    EXPECT_TRUE(link.poll(start));
}

TEST(Link, GivesBackTheBytesItWasGiven)
{
    Link link{Pipeline{}};
    for (const int value : {1, 2, 3}) {
        const std::vector<std::byte> bytes(static_cast<std::size_t>(value),
                                           static_cast<std::byte>(value));
        link.on_packet(bytes, start);
        auto datagram = link.poll(start);
        ASSERT_TRUE(datagram);
        EXPECT_EQ(datagram->bytes, bytes);
        link.on_sent(*std::move(datagram), start);
    }
}

TEST(Link, CarriesAnEmptyDatagram)
{
    Link link{Pipeline{}};
    link.on_packet({}, start);
    const auto datagram = link.poll(start);
    ASSERT_TRUE(datagram);
    EXPECT_TRUE(datagram->bytes.empty());
}

TEST(Link, CountsADatagramAsInFlightUntilItIsKnownToHaveLeft)
{
    Link link{Pipeline{}};
    link.on_packet(payload, start);
    auto datagram = link.poll(start);
    EXPECT_EQ(link.statistics().in_flight, 1U);
    link.on_sent(*std::move(datagram), start + 3us);
    EXPECT_EQ(link.statistics().in_flight, 0U);
    EXPECT_EQ(link.statistics().delivered, 1U);
    EXPECT_EQ(link.statistics().bytes_in, 96U);
    EXPECT_EQ(link.statistics().bytes_out, 96U);
    EXPECT_EQ(link.statistics().lateness.max(), 3us);
}

TEST(Link, CountsAFailedSendUnderItsCause)
{
    Link link{Pipeline{}};
    link.on_packet(payload, start);
    link.on_failed(*link.poll(start), DropCause::no_route);
    EXPECT_EQ(link.statistics().dropped_by(DropCause::no_route), 1U);
    EXPECT_EQ(link.statistics().delivered, 0U);
    EXPECT_EQ(link.statistics().in_flight, 0U);
    EXPECT_EQ(link.statistics().bytes_out, 0U);
}

TEST(Link, DropsAndCountsWhatExceedsTheBoundOfItsQueue)
{
    Link link{Pipeline{{ConstantDelay{1s}}}, Order::keep, {.datagrams_max = 2}};
    link.on_packet(payload, start);
    link.on_packet(payload, start);
    EXPECT_EQ(link.on_packet(payload, start), Verdict{Drop{DropCause::queue_full}});
    EXPECT_EQ(link.statistics().dropped_by(DropCause::queue_full), 1U);
    EXPECT_EQ(link.statistics().in_flight, 2U);
}

TEST(Link, DropsAndCountsWhatExceedsTheBytesOfItsQueue)
{
    Link link{Pipeline{{ConstantDelay{1s}}}, Order::keep, {.datagrams_max = 9, .bytes_max = 191}};
    EXPECT_EQ(link.on_packet(payload, start), Verdict{Deliver{1s}});
    EXPECT_EQ(link.on_packet(payload, start), Verdict{Drop{DropCause::queue_full}});
    std::ignore = link.poll(start + 1s);
    EXPECT_EQ(link.on_packet(payload, start), Verdict{Deliver{1s}});
}

TEST(Link, DoesNotHoldUpTheNextDatagramBehindOneThatDidNotFit)
{
    const base::Seed seed{1};
    Link link{Pipeline{{ConstantDelay{1s}, UniformJitter{1s, seed.stream("up/jitter")}}},
              Order::keep,
              {.datagrams_max = 1}};
    link.on_packet(payload, start);
    const auto due = link.next_deadline();
    for (int i = 0; i < 100; ++i) link.on_packet(payload, start);
    std::ignore = link.poll(*due);
    link.on_packet(payload, start);
    EXPECT_LE(*link.next_deadline(), std::max(*due, start + 2s));
}

TEST(Link, NeverReordersUnderJitterWhenOrderIsKept)
{
    const auto numbers = numbers_that_leave(Order::keep, 10ms, 200);
    EXPECT_EQ(numbers.size(), 200U);
    EXPECT_TRUE(std::is_sorted(numbers.begin(), numbers.end()));
}

TEST(Link, ReordersUnderWideJitterWhenOrderIsFree)
{
    const auto numbers = numbers_that_leave(Order::free, 10ms, 200);
    EXPECT_EQ(numbers.size(), 200U);
    EXPECT_FALSE(std::is_sorted(numbers.begin(), numbers.end()));
}

TEST(Link, KeepsOrderByTheLaterOfOwnDelayAndPredecessor)
{
    const base::Seed seed{3};
    const UniformJitter jitter{5ms, seed.stream("up/jitter")};
    Link link{Pipeline{{ConstantDelay{5ms}, jitter}}, Order::keep};
    auto previous = base::TimePoint::min();
    for (std::uint64_t number = 0; number < 50; ++number) {
        const auto arrival = start + static_cast<int>(number) * 1ms;
        link.on_packet(payload, arrival);
        const auto own = 5ms + std::get<Deliver>(jitter.on_packet(number)).after;
        previous = std::max(previous, arrival + own);
        auto datagram = link.poll(start + 1h);
        ASSERT_TRUE(datagram);
        EXPECT_EQ(datagram->due, previous);
        link.on_sent(*std::move(datagram), previous);
    }
}

TEST(Link, LetsEqualDueTimesLeaveInTheOrderOfArrival)
{
    Link link{Pipeline{{ConstantDelay{1ms}}}, Order::free};
    for (int i = 0; i < 5; ++i) link.on_packet(payload, start);
    for (std::uint64_t i = 0; i < 5; ++i) EXPECT_EQ(link.poll(start + 1ms)->number, i);
}

TEST(Link, CountsAsReorderedWhatLeavesAfterAHigherNumber)
{
    Link link{Pipeline{}};
    for (int i = 0; i < 4; ++i) link.on_packet(payload, start);
    std::array<std::optional<Datagram>, 4> taken;
    for (auto& datagram : taken) datagram = link.poll(start);
    for (const std::size_t number : {1U, 0U, 3U, 2U}) {
        link.on_sent(*std::move(taken[number]), start);
    }
    EXPECT_EQ(link.statistics().reordered, 2U); // 0 after 1, 2 after 3 (RFC 4737)
}

TEST(Link, NumbersWhatItLosesToo)
{
    Link link{Pipeline{{RandomLoss{100_percent, base::Seed{1}.stream("up/random-loss")}}}};
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(link.on_packet(payload, start), Verdict{Drop{DropCause::random_loss}});
    }
    EXPECT_EQ(link.statistics().received, 3U);
    EXPECT_EQ(link.statistics().bytes_in, 3U * 96U);
    EXPECT_FALSE(link.next_deadline());
}

} // namespace hapnet::emulator
