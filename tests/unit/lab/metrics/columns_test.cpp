// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/columns.hpp"

#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

namespace hapnet::lab::metrics {
namespace {

TEST(Columns, SayWhoFollows)
{
    std::vector<virtual_time::Sample> side(3);
    side[0].remote_touching = true;
    side[1].remote_touching = true;
    side[1].touching = true;
    side[2].holding = true;
    const Columns columns = columns_of(side);
    EXPECT_EQ(columns.follows, (std::vector<std::uint8_t>{1, 0, 0}));
    EXPECT_EQ(columns.touching, (std::vector<std::uint8_t>{0, 1, 1}));
    EXPECT_TRUE(columns_of({}).body_x.empty());
}

} // namespace
} // namespace hapnet::lab::metrics
