// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/figures/reorder_extents.hpp"

#include <gtest/gtest.h>
#include <type_traits>

namespace hapnet::base {
namespace {

// It owns no memory: adding cannot allocate.
static_assert(std::is_trivially_copyable_v<ReorderExtents>);

TEST(ReorderExtents, CountFromTheFirstArrivalWithAHigherNumber)
{
    ReorderExtents extents;
    for (const std::uint64_t number : {1U, 4U, 5U, 6U}) extents.in_order(number);
    EXPECT_EQ(extents.reordered(2).arrivals, 3U); // after 4
    const auto last = extents.reordered(3);       // after 4, too: 2 is an arrival between them
    EXPECT_EQ(last.arrivals, 4U);
    EXPECT_FALSE(last.is_cut);
    extents.in_order(7);
    EXPECT_EQ(extents.reordered(0).arrivals, 7U); // after 1
}

TEST(ReorderExtents, AreCutWhereTheyLookBack)
{
    constexpr auto far = ReorderExtents::looks_back;
    ReorderExtents extents;
    for (std::uint64_t number = 1; number <= far; ++number) extents.in_order(number);
    const auto whole = extents.reordered(0);
    EXPECT_EQ(whole.arrivals, far);
    EXPECT_FALSE(whole.is_cut);
    extents.in_order(far + 1); // 1 is forgotten
    const auto cut = extents.reordered(0);
    EXPECT_EQ(cut.arrivals, far + 1); // since 2, of far + 2 since 1
    EXPECT_TRUE(cut.is_cut);
}

} // namespace
} // namespace hapnet::base
