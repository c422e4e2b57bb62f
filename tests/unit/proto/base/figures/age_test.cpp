// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/figures/age.hpp"

#include <gtest/gtest.h>
#include <type_traits>

namespace hapnet::base {
namespace {

using namespace std::chrono_literals;

constexpr TimePoint start{1h};

// It owns no memory: adding cannot allocate.
static_assert(std::is_trivially_copyable_v<AgeMeter>);

TEST(AgeMeter, KnowsNoAgeBeforeTheSecondUpdate)
{
    AgeMeter meter;
    EXPECT_EQ(meter.age(), Age{});
    meter.add(start, 4ms);
    EXPECT_EQ(meter.age(), Age{});
    EXPECT_EQ(meter.newest_arrived(), start);
}

TEST(AgeMeter, FollowsTheAgeFromUpdateToUpdate)
{
    AgeMeter meter;
    meter.add(start, 4ms);
    meter.add(start + 1ms, 3ms); // from 4 to 5 ms
    meter.add(start + 5ms, 4ms); // from 3 to 7 ms
    // (1 ms at 4.5 ms on average + 4 ms at 5 ms on average) / 5 ms
    EXPECT_EQ(meter.age(), (Age{.mean = 4'900us, .peak_mean = 6ms, .peak_max = 7ms}));
}

TEST(AgeMeter, HasPeaksAndNoMeanWhereNoTimeHasPassed)
{
    AgeMeter meter;
    meter.add(start, 4ms);
    meter.add(start, 3ms);
    EXPECT_EQ(meter.age(), (Age{.mean = {}, .peak_mean = 4ms, .peak_max = 4ms}));
}

TEST(AgeMeter, CountsNoTimeBetweenAPauseAndTheNextUpdate)
{
    AgeMeter meter;
    meter.add(start, 4ms);
    meter.pause();
    EXPECT_FALSE(meter.newest_arrived());
    meter.add(start + 1s, 2ms);
    EXPECT_EQ(meter.age(), Age{});
    meter.add(start + 1s + 2ms, 2ms);
    EXPECT_EQ(meter.age(), (Age{.mean = 3ms, .peak_mean = 4ms, .peak_max = 4ms}));
}

} // namespace
} // namespace hapnet::base
