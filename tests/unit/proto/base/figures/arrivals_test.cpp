// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/figures/arrivals.hpp"

#include <gtest/gtest.h>
#include <type_traits>
#include <vector>

namespace hapnet::base {
namespace {

// It owns no memory: adding cannot allocate.
static_assert(std::is_trivially_copyable_v<ArrivalCounter>);

// RFC 4737, 3.4: the arrivals of an example of the metric, of which 4, 5 and 6 are reordered.
TEST(NextExpected, TellsReorderedArrivals)
{
    NextExpected expected{1};
    std::vector<std::uint64_t> reordered;
    for (const std::uint64_t number : {1U, 2U, 3U, 7U, 8U, 9U, 10U, 4U, 5U, 6U, 11U}) {
        if (!expected.add(number)) reordered.push_back(number);
    }
    EXPECT_EQ(reordered, (std::vector<std::uint64_t>{4, 5, 6}));
    EXPECT_EQ(expected.next(), 12U);
}

TEST(NextExpected, TellsHowManyNumbersAnArrivalSkips)
{
    NextExpected expected;
    EXPECT_EQ(expected.add(2), 2U);
    EXPECT_EQ(expected.add(3), 0U);
    EXPECT_EQ(expected.add(10), 6U);
    EXPECT_EQ(expected.add(10), std::nullopt); // a copy comes after the number that is expected
    EXPECT_EQ(expected.next(), 11U);
}

TEST(ArrivalCounter, CountsWhatIsDuplicatedAndOvertakenUpToTheHighestNumber)
{
    using Arrival = ArrivalCounter::Arrival;
    ArrivalCounter counter{1};
    EXPECT_EQ(counter.counts(), ArrivalCounts{});
    EXPECT_EQ(counter.add(2, false), Arrival::in_order);
    EXPECT_EQ(counter.add(7, false), Arrival::in_order);
    EXPECT_EQ(counter.add(7, true), Arrival::duplicate);
    EXPECT_EQ(counter.add(5, false), Arrival::reordered);
    EXPECT_EQ(counter.add(2, true), Arrival::duplicate);
    EXPECT_EQ(counter.counts(),
              (ArrivalCounts{.sent = 7, .received = 3, .duplicates = 2, .reordered = 1}));
}

TEST(ArrivalCounter, CountsFromTheFirstNumberOfTheStream)
{
    ArrivalCounter counter{0};
    counter.add(0, false);
    EXPECT_EQ(counter.counts().sent, 1U);
    counter.add(4, false);
    EXPECT_EQ(counter.counts().sent, 5U);
}

} // namespace
} // namespace hapnet::base
