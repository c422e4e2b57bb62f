// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay_line.hpp"

#include "emulator/core/slab.hpp"
#include "proto/base/random.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

namespace hapnet::emulator::delay_line_test {

namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{1h};

Datagram due_at(base::TimePoint due, std::uint64_t number)
{
    return {.number = number, .arrival = start, .due = due};
}

} // namespace

TEST(DelayLine, GivesTheEarliestFirst)
{
    DelayLine line{8};
    line.push(due_at(start + 3ms, 0));
    line.push(due_at(start + 1ms, 1));
    line.push(due_at(start + 2ms, 2));
    line.push(due_at(start + 4ms, 3));
    EXPECT_EQ(line.next_due(), start + 1ms);
    for (const std::uint64_t number : {1U, 2U, 0U, 3U}) {
        EXPECT_EQ(line.pop(start + 1h)->number, number);
    }
    EXPECT_FALSE(line.pop(start + 1h));
    EXPECT_FALSE(line.next_due());
}

TEST(DelayLine, GivesNothingThatIsNotDue)
{
    DelayLine line{8};
    line.push(due_at(start + 1ms, 0));
    EXPECT_FALSE(line.pop(start + 1ms - 1ns));
    EXPECT_EQ(line.size(), 1U);
}

TEST(DelayLine, LetsEqualTimesLeaveInTheOrderInWhichTheyCame)
{
    DelayLine line{8};
    line.push(due_at(start + 2ms, 0));
    line.push(due_at(start + 1ms, 1)); // into the heap
    line.push(due_at(start + 1ms, 2));
    line.push(due_at(start + 2ms, 3));
    for (const std::uint64_t number : {1U, 2U, 0U, 3U}) {
        EXPECT_EQ(line.pop(start + 1h)->number, number);
    }
}

TEST(DelayLine, GivesSortedDatagramsInOrderAtTheTimesOfAllOfThem)
{
    DelayLine line{8};
    line.push_sorted(due_at(start + 3ms, 0));
    line.push_sorted(due_at(start + 1ms, 1));
    line.push_sorted(due_at(start + 2ms, 2));
    for (const std::uint64_t number : {0U, 1U, 2U}) {
        const auto datagram = line.pop(start + 1h);
        EXPECT_EQ(datagram->number, number);
        EXPECT_EQ(datagram->due, start + 1ms * (number + 1));
    }
    EXPECT_EQ(line.size(), 0U);
}

TEST(DelayLine, IsFullAtItsBoundHoweverTheDatagramsCameIn)
{
    DelayLine line{3};
    line.push(due_at(start + 2ms, 0));
    line.push(due_at(start + 1ms, 1));
    EXPECT_FALSE(line.is_full());
    line.push_sorted(due_at(start + 3ms, 2));
    EXPECT_TRUE(line.is_full());
    EXPECT_TRUE(line.pop(start + 1h));
    EXPECT_FALSE(line.is_full());
}

TEST(DelayLine, GivesWhatAPlainSortGivesForAnyTimes)
{
    const auto chance = base::Seed{1}.stream("times");
    DelayLine line{64};
    std::vector<Datagram> expected;
    for (std::uint64_t number = 0; number < 64; ++number) {
        expected.push_back(due_at(start + 1ms * chance.below(20, number), number));
        line.push(expected.back());
    }
    std::stable_sort(expected.begin(), expected.end(),
                     [](const Datagram& a, const Datagram& b) { return a.due < b.due; });
    for (const Datagram& datagram : expected) {
        EXPECT_EQ(line.pop(start + 1h)->number, datagram.number);
    }
}

} // namespace hapnet::emulator::delay_line_test
