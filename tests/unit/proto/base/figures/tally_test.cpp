// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/figures/tally.hpp"

#include <gtest/gtest.h>

namespace hapnet::base {
namespace {

TEST(Tally, KnowsNumberSumMaximumAndMean)
{
    Tally tally;
    EXPECT_EQ(tally.mean(), std::nullopt);
    for (const std::uint64_t value : {3U, 8U, 1U}) tally.add(value);
    EXPECT_EQ(tally, (Tally{.count = 3, .sum = 12, .max = 8}));
    EXPECT_EQ(tally.mean(), 4.0);
}

} // namespace
} // namespace hapnet::base
