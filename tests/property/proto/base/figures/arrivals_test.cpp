// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/figures/arrivals.hpp"

#include "tests/property/proto/base/figures/random_arrivals.hpp"

#include <gtest/gtest.h>

namespace hapnet::base {
namespace {

/// Counts arrivals of this number before this place.
std::size_t earlier(const std::vector<RandomArrival>& arrivals, std::size_t place, auto is_meant)
{
    const auto here = arrivals.begin() + static_cast<std::ptrdiff_t>(place);
    return static_cast<std::size_t>(std::count_if(
        arrivals.begin(), here, [&](const RandomArrival& one) { return is_meant(one.number); }));
}

TEST(ArrivalCounter, CountsAsTheDefinitionsDoOverTheWholeList)
{
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        const std::uint64_t first = seed % 3;
        const auto arrivals = random_arrivals(seed, first);
        ArrivalCounter counter{first};
        ArrivalCounts expected;
        for (std::size_t i = 0; i < arrivals.size(); ++i) {
            const auto number = arrivals[i].number;
            const bool is_copy =
                earlier(arrivals, i, [&](std::uint64_t one) { return one == number; }) > 0;
            const bool is_overtaken =
                earlier(arrivals, i, [&](std::uint64_t one) { return one > number; }) > 0;
            expected.received += is_copy ? 0 : 1;
            expected.duplicates += is_copy ? 1 : 0;
            expected.reordered += !is_copy && is_overtaken ? 1 : 0;
            const auto arrival = counter.add(number, is_copy);
            ASSERT_EQ(arrival == ArrivalCounter::Arrival::in_order, !is_copy && !is_overtaken)
                << seed << " " << i;
        }
        if (!arrivals.empty()) {
            expected.sent =
                std::ranges::max(arrivals, {}, &RandomArrival::number).number - first + 1;
        }
        ASSERT_EQ(counter.counts(), expected) << seed;
    }
}

TEST(NextExpected, SkipsTheNumbersBelowWhichNeitherTheyNorHigherOnesCame)
{
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        const auto arrivals = without_copies(random_arrivals(seed, 0));
        NextExpected expected;
        for (std::size_t i = 0; i < std::min<std::size_t>(arrivals.size(), 100); ++i) {
            const auto skipped = expected.add(arrivals[i].number);
            ASSERT_EQ(skipped.has_value(), is_in_order(arrivals, i)) << seed << " " << i;
            if (!skipped) continue;
            std::uint64_t missing = 0;
            for (std::uint64_t number = 0; number < arrivals[i].number; ++number) {
                const auto is_there = [&](std::uint64_t one) { return one >= number; };
                if (earlier(arrivals, i, is_there) == 0) ++missing;
            }
            ASSERT_EQ(*skipped, missing) << seed << " " << i;
        }
    }
}

} // namespace
} // namespace hapnet::base
