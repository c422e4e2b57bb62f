// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/secure/costs.hpp"
#include "tests/bench/secure/turns.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace hapnet::bench {
namespace {

TEST(CostsOfKeys, AreRowsWithTargetsAndTheTurnHasABaseline)
{
    const auto rows = measure_costs_of_keys(1);
    ASSERT_EQ(rows.size(), 8U);
    EXPECT_EQ(std::ranges::count_if(rows, [](const Row& row) { return row.target.has_value(); }),
              7);
    EXPECT_EQ(rows[1].baseline, "without");
    EXPECT_TRUE(rows[1].baseline_value);
    for (const std::size_t timed : {0U, 1U, 6U, 7U}) EXPECT_GT(rows[timed].value, 0.0) << timed;
}

TEST(TurnsOfMany, CostMoreTheMorePlay)
{
    const auto rows = measure_turns_of_many(1);
    ASSERT_EQ(rows.size(), 12U);
    EXPECT_EQ(rows[6].name, "a turn of one of 8 peers, T7");
    EXPECT_LT(rows[0].value, rows[6].value);
    EXPECT_LT(rows[1].value, rows[7].value);
    for (const Row& row : rows) EXPECT_GT(row.value, 0.0) << row.name;
    EXPECT_EQ(rows.back().value, 838.0) << "all eight are in a message";
}

} // namespace
} // namespace hapnet::bench
