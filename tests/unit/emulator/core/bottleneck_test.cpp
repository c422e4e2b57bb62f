// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/bottleneck.hpp"

#include "proto/base/random.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <span>
#include <utility>
#include <vector>

namespace hapnet::emulator {

namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{1h};

/// 1 Mbit/s, 25 bytes of overhead, 1000 bytes of queue: 100 bytes of payload take 1 ms.
const Rate megabit{1'000'000, 25, 1000};

using Sent = std::vector<std::pair<std::uint64_t, base::TimePoint>>;

constexpr std::array<std::byte, 1000> payload{};

/// Datagram `number`, of `bytes` bytes, arrives at `now`.
void push(Bottleneck& line, std::uint64_t number, std::size_t bytes, base::TimePoint now)
{
    line.push({.number = number, .arrival = now, .bytes = std::span{payload}.first(bytes)}, {});
}

Sent all_of(Bottleneck& line)
{
    Sent sent;
    while (const auto one = line.pop(start + 1h)) {
        sent.emplace_back(one->datagram.number, one->datagram.due);
    }
    return sent;
}

} // namespace

TEST(Bottleneck, TakesTheTimeOfTheBitsWithTheirOverhead)
{
    Bottleneck line{megabit, 8};
    push(line, 1, 100, start);
    EXPECT_EQ(line.next_sent(), start + 1ms);
    EXPECT_FALSE(line.pop(start + 1ms - 1ns));
    EXPECT_EQ(line.pop(start + 1ms)->datagram.due, start + 1ms);
    EXPECT_FALSE(line.next_sent());
}

TEST(Bottleneck, SendsOneAfterTheOther)
{
    Bottleneck line{megabit, 8};
    push(line, 1, 100, start);
    push(line, 2, 100, start + 500us);
    push(line, 3, 225, start + 500us);
    EXPECT_EQ(all_of(line), (Sent{{1, start + 1ms}, {2, start + 2ms}, {3, start + 4ms}}));
}

TEST(Bottleneck, LetsABurstLeaveAtOnceAndSavesUpAnotherOneWhileItIsIdle)
{
    // 8 Mbit/s are a byte a microsecond; the bucket holds three of these datagrams.
    Bottleneck line{{.bits_per_second = 8'000'000,
                     .overhead_bytes = 0,
                     .queue_bytes_max = 64 << 10,
                     .burst_bytes = 3000},
                    16};
    for (std::uint64_t number = 1; number <= 5; ++number) push(line, number, 1000, start);
    EXPECT_EQ(all_of(line),
              (Sent{{1, start}, {2, start}, {3, start}, {4, start + 1ms}, {5, start + 2ms}}));
    push(line, 6, 1000, start + 3500us); // 1500 bytes were saved up
    push(line, 7, 1000, start + 3500us);
    EXPECT_EQ(all_of(line), (Sent{{6, start + 3500us}, {7, start + 4ms}}));
    for (std::uint64_t number = 8; number <= 11; ++number) push(line, number, 1000, start + 1s);
    EXPECT_EQ(all_of(line),
              (Sent{{8, start + 1s}, {9, start + 1s}, {10, start + 1s}, {11, start + 1001ms}}));
}

TEST(Bottleneck, WithABurstFollowsTheRuleOfATokenBucket)
{
    // In nanoseconds times bits a second, so that only the result is rounded.
    constexpr std::uint64_t rate = 7'000'001;
    constexpr std::int64_t burst = 4000;
    Bottleneck line{{.bits_per_second = rate,
                     .overhead_bytes = 28,
                     .queue_bytes_max = 1 << 30,
                     .burst_bytes = burst},
                    1 << 16,
                    start};
    const auto chance = base::Seed{7}.stream("arrivals");
    __extension__ typedef __int128 Exact;
    Exact finished = -Exact{burst} * work_per_byte;
    Sent expected;
    Sent sent;
    base::Duration at{};
    for (std::uint64_t number = 0; number < 20'000; ++number) {
        const auto bytes = static_cast<std::size_t>(chance.bits(number, 0) % 1000);
        const auto pause = chance.bits(number, 1) % (number % 100 == 0 ? 20'000'000 : 900'000);
        at += base::Duration{static_cast<base::Duration::rep>(pause)};
        const Exact arrival = Exact{at.count()} * rate;
        finished = std::max(finished, arrival - Exact{burst} * work_per_byte) +
                   Exact{static_cast<std::int64_t>(bytes + 28)} * work_per_byte;
        const Exact leaves = std::max(arrival, finished);
        const auto due = static_cast<std::int64_t>((leaves + rate - 1) / rate);
        expected.emplace_back(number, start + base::Duration{due});
        while (const auto one = line.pop(start + at)) {
            sent.emplace_back(one->datagram.number, one->datagram.due);
        }
        push(line, number, bytes, start + at);
    }
    while (const auto one = line.pop(start + 1h)) {
        sent.emplace_back(one->datagram.number, one->datagram.due);
    }
    EXPECT_EQ(sent, expected);
}

TEST(Bottleneck, KeepsWhatItHasSavedUpWhenTheRateChangesAndNoMoreThanTheNewBurst)
{
    const Rate before{.bits_per_second = 8'000'000, .overhead_bytes = 0, .burst_bytes = 3000};
    Bottleneck line{before, 16, start};
    push(line, 1, 1000, start);
    push(line, 2, 1000, start);
    EXPECT_EQ(all_of(line).size(), 2U); // 1000 bytes are left
    Rate slower = before;
    slower.bits_per_second = 800'000;
    line.change(slower, start + 500us); // and 500 were saved up at the old rate
    push(line, 3, 1000, start + 500us);
    push(line, 4, 1000, start + 500us);
    EXPECT_EQ(all_of(line), (Sent{{3, start + 500us}, {4, start + 5500us}}));
}

TEST(Bottleneck, HasRoomForItsQueueBesidesTheOneBeingSent)
{
    Bottleneck line{{1'000'000, 25, 250}, 8};
    EXPECT_TRUE(line.has_room(65'507)); // an idle line takes anything
    push(line, 1, 100, start);
    push(line, 2, 100, start);
    EXPECT_TRUE(line.has_room(100));
    EXPECT_FALSE(line.has_room(101));
    push(line, 3, 100, start);
    EXPECT_FALSE(line.has_room(0));
    EXPECT_TRUE(line.pop(start + 1ms));
    EXPECT_TRUE(line.has_room(100));
}

TEST(Bottleneck, HasNoRoomBeyondTheNumberItWasMadeFor)
{
    Bottleneck line{{1'000'000, 25, 1'000'000}, 2};
    push(line, 1, 100, start);
    push(line, 2, 100, start);
    EXPECT_FALSE(line.has_room(0));
}

TEST(Bottleneck, CountsTheBitsAlreadySentWhenTheRateChanges)
{
    Bottleneck line{megabit, 8};
    push(line, 1, 100, start); // 1000 bits
    push(line, 2, 100, start);
    line.change({2'000'000, 25, 1000}, start + 400us); // 600 bits are left, at twice the rate
    EXPECT_EQ(all_of(line), (Sent{{1, start + 700us}, {2, start + 1200us}}));
}

TEST(Bottleneck, LetsAllGoWhenTheRateIsTakenAway)
{
    Bottleneck line{megabit, 8};
    push(line, 1, 100, start);
    push(line, 2, 100, start);
    line.change({}, start + 400us);
    EXPECT_EQ(all_of(line), (Sent{{1, start + 400us}, {2, start + 400us}}));
}

TEST(Bottleneck, RoundsOnceAndNotOncePerDatagram)
{
    // 8 bits at 3 bit/s: 2.666... s each, so that three of them take 8 s to the nanosecond.
    Bottleneck line{{3, 0, 1000}, 8};
    for (const std::uint64_t number : {1U, 2U, 3U}) push(line, number, 1, start);
    const auto sent = all_of(line);
    EXPECT_EQ(sent[0].second, start + 2'666'666'667ns);
    EXPECT_EQ(sent[1].second, start + 5'333'333'334ns);
    EXPECT_EQ(sent[2].second, start + 8s);
}

TEST(Bottleneck, FollowsLindleysRecursionToTheNanosecondForAnyArrivals)
{
    // Departure n = max(arrival n, departure n-1) + bits / rate (Lindley 1952): within a busy
    // period its beginning plus all its bits, rounded up once.
    constexpr std::uint64_t bits_per_second = 142'857'143;
    const auto chance = base::Seed{3}.stream("arrivals");
    Bottleneck line{{bits_per_second, 0, 1U << 30}, 4096};
    std::vector<base::TimePoint> expected;
    auto busy_since = start;
    std::uint64_t bits = 0;
    auto now = start;
    std::size_t sent = 0;
    for (std::uint64_t n = 0; n < 5000; ++n) {
        now += base::Duration{static_cast<std::int64_t>(chance.below(60'000, n))};
        while (const auto one = line.pop(now)) ASSERT_EQ(one->datagram.due, expected.at(sent++));
        const std::size_t bytes = 1 + chance.below(1000, n, 1);
        push(line, n, bytes, now);
        if (n == 0 || expected.back() <= now) {
            busy_since = now;
            bits = 0;
        }
        bits += 8 * bytes;
        const std::uint64_t took = (bits * 1'000'000'000 + bits_per_second - 1) / bits_per_second;
        expected.push_back(busy_since + base::Duration{static_cast<std::int64_t>(took)});
    }
    EXPECT_GT(sent, 4900U);
}

} // namespace hapnet::emulator
