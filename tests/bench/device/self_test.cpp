// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/device/overhead.hpp"
#include "tests/bench/device/ticks.hpp"

#include <gtest/gtest.h>

namespace hapnet::bench {
namespace {

TEST(Ticks, FeelTheCubeWithAndWithoutAGovernor)
{
    for (const Load load : {Load::contact, Load::governed}) {
        Ticks ticks{load};
        EXPECT_GT(base::norm(ticks.felt()), 0.1);
        if (load == Load::governed) {
            EXPECT_EQ(ticks.governor().state(), device::GovernorState::active);
        }
    }
}

TEST(Overhead, IsARowWithATargetAndABaseline)
{
    const auto rows = measure_overhead(1);
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0].metric, "p50_us");
    EXPECT_EQ(rows[0].target, 10.0);
    EXPECT_TRUE(rows[0].baseline_value);
    EXPECT_FALSE(rows[1].target);
}

} // namespace
} // namespace hapnet::bench
