// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/figures/delay_meter.hpp"

#include "proto/base/figures/quantiles.hpp"
#include "proto/base/histogram.hpp"

#include <gtest/gtest.h>
#include <type_traits>
#include <vector>

namespace hapnet::base {
namespace {

using namespace std::chrono_literals;
using Values = std::vector<Duration>;

// It owns no memory: adding cannot allocate.
static_assert(std::is_trivially_copyable_v<DelayMeter<DurationHistogram>>);

TEST(DelayMeter, ComparesDelaysOfArrivalsInARow)
{
    DelayMeter<DurationSample> meter;
    for (const auto delay : {10ms, 13ms, 11ms}) meter.add(delay);
    EXPECT_EQ(meter.delays().values(), (Values{10ms, 13ms, 11ms}));
    EXPECT_EQ(meter.variations().values(), (Values{3ms, 2ms}));
}

TEST(DelayMeter, ComparesNothingAcrossAPause)
{
    DelayMeter<DurationSample> meter;
    meter.add(10ms);
    meter.pause();
    meter.add(90ms);
    meter.add(91ms);
    EXPECT_EQ(meter.delays().count(), 3U);
    EXPECT_EQ(meter.variations().values(), Values{1ms});
}

TEST(DelayMeter, LeavesTheLeadOfAClockOutOfVariations)
{
    DelayMeter<DurationHistogram> meter;
    meter.add(5s + 40ms, 5s);
    meter.add(5s + 43ms, 5s + 1ms); // the clock is known better now
    EXPECT_EQ(meter.delays().max(), 42ms);
    EXPECT_EQ(meter.variations().max(), 3ms);
}

} // namespace
} // namespace hapnet::base
