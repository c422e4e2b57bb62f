// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/figures/reorder_extents.hpp"

#include "tests/property/proto/base/figures/random_arrivals.hpp"

#include <gtest/gtest.h>

namespace hapnet::base {
namespace {

TEST(ReorderExtents, AreTheDistancesToTheFirstArrivalWithAHigherNumber)
{
    std::size_t reordered = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        const auto arrivals = without_copies(random_arrivals(seed, 0));
        ReorderExtents extents;
        for (std::size_t i = 0; i < arrivals.size(); ++i) {
            const auto overtaker = std::ranges::find_if(arrivals, [&](const RandomArrival& one) {
                return one.number > arrivals[i].number;
            });
            const auto place = static_cast<std::size_t>(overtaker - arrivals.begin());
            if (place >= i) {
                extents.in_order(arrivals[i].number);
                continue;
            }
            const auto extent = extents.reordered(arrivals[i].number);
            ASSERT_EQ(extent.arrivals, i - place) << seed << " " << i;
            ASSERT_FALSE(extent.is_cut); // a stream has fewer arrivals than are remembered
            ++reordered;
        }
    }
    EXPECT_GT(reordered, 1000U);
}

} // namespace
} // namespace hapnet::base
