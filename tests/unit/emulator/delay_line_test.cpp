// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay_line.hpp"

#include "emulator/core/buffer_pool.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

namespace hapnet::emulator {

namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{1h};

Datagram due_at(base::TimePoint due, std::uint64_t number, std::size_t bytes = 10)
{
    return {std::vector<std::byte>(bytes), number, start, due};
}

} // namespace

TEST(DelayLine, GivesTheEarliestFirst)
{
    DelayLine line;
    line.push(due_at(start + 3ms, 0));
    line.push(due_at(start + 1ms, 1));
    line.push(due_at(start + 2ms, 2));
    EXPECT_EQ(line.next_due(), start + 1ms);
    EXPECT_EQ(line.pop(start + 1h)->number, 1U);
    EXPECT_EQ(line.pop(start + 1h)->number, 2U);
    EXPECT_EQ(line.pop(start + 1h)->number, 0U);
    EXPECT_FALSE(line.pop(start + 1h));
    EXPECT_FALSE(line.next_due());
}

TEST(DelayLine, GivesNothingThatIsNotDue)
{
    DelayLine line;
    line.push(due_at(start + 1ms, 0));
    EXPECT_FALSE(line.pop(start + 1ms - 1ns));
    EXPECT_EQ(line.size(), 1U);
}

TEST(DelayLine, HasRoomUntilEitherLimitIsReached)
{
    DelayLine few{{.datagrams_max = 1}};
    EXPECT_TRUE(few.has_room(65'507));
    few.push(due_at(start, 0));
    EXPECT_FALSE(few.has_room(0));

    DelayLine small{{.datagrams_max = 10, .bytes_max = 100}};
    EXPECT_FALSE(small.has_room(101));
    small.push(due_at(start, 0, 60));
    EXPECT_TRUE(small.has_room(40));
    EXPECT_FALSE(small.has_room(41));
}

TEST(DelayLine, HasRoomAgainWhenADatagramHasLeft)
{
    DelayLine line{{.datagrams_max = 1, .bytes_max = 100}};
    for (std::uint64_t number = 0; number < 50; ++number) {
        line.push(due_at(start, number, 100));
        EXPECT_FALSE(line.has_room(0));
        EXPECT_TRUE(line.pop(start));
    }
}

TEST(BufferPool, UsesABufferAgain)
{
    BufferPool pool{4};
    const std::array<std::byte, 100> bytes{};
    auto buffer = pool.copy_of(bytes);
    const auto* place = buffer.data();
    pool.give_back(std::move(buffer));
    EXPECT_EQ(pool.copy_of(bytes).data(), place);
}

TEST(BufferPool, DoesNotKeepTheMemoryOfHugeDatagrams)
{
    BufferPool pool{4};
    std::vector<std::byte> huge(BufferPool::kept_bytes_max + 1);
    pool.give_back(std::move(huge));
    EXPECT_EQ(pool.copy_of({}).capacity(), 0U);
}

} // namespace hapnet::emulator
