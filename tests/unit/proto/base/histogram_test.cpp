// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/histogram.hpp"

#include <gtest/gtest.h>

namespace hapnet::base {
namespace {

using namespace std::chrono_literals;

TEST(Histogram, OfNothingHasNoQuantileAndNoMaximum)
{
    const DurationHistogram nothing;
    EXPECT_EQ(nothing.count(), 0U);
    EXPECT_EQ(nothing.quantile(0.5), std::nullopt);
    EXPECT_EQ(nothing.quantiles(), std::nullopt);
    EXPECT_EQ(nothing.min(), std::nullopt);
    EXPECT_EQ(nothing.max(), std::nullopt);
    EXPECT_EQ(nothing.count_above(0ns), 0U);
}

TEST(Histogram, OfEqualValuesHasThemAsEveryQuantile)
{
    DurationHistogram histogram;
    for (int i = 0; i < 1000; ++i) histogram.add(20'010us);
    EXPECT_EQ(histogram.quantiles(), (Quantiles{20'010us, 20'010us, 20'010us, 20'010us, 20'010us}));
}

TEST(Histogram, TakesTheValuesOfABinToLieEvenlyInIt)
{
    DurationHistogram histogram; // one bin goes from 19 923 to 20 185 us
    for (int i = 0; i <= 100; ++i) histogram.add(20'000us + i * 1us);
    EXPECT_EQ(histogram.quantile(0.5), 20'050us);
    EXPECT_NEAR(static_cast<double>(histogram.quantile(0.9)->count()), 20'090e3, 1e3);
    histogram.add(25ms); // the bin is open above again
    EXPECT_NEAR(static_cast<double>(histogram.quantile(0.5)->count()), 20'050e3, 45e3);
}

TEST(Histogram, CountsAboveALimitAsItsQuantilesAre)
{
    DurationHistogram histogram;
    for (int i = 0; i < 1000; ++i) histogram.add(20'000us + (i % 200) * 1us);
    for (const auto limit : {19'999us, 20'000us, 20'033us, 20'180us, 20'199us, 30'000us}) {
        std::uint64_t above = 0;
        for (int rank = 1; rank <= 1000; ++rank)
            above += *histogram.quantile((rank - 0.5) / 1000.0) > limit ? 1U : 0U;
        EXPECT_EQ(histogram.count_above(limit), above) << limit.count();
    }
}

TEST(Histogram, IsExactBelow128Nanoseconds)
{
    DurationHistogram histogram;
    for (int i = 0; i < 128; ++i) histogram.add(Duration{i});
    for (int i = 0; i < 128; ++i) {
        EXPECT_EQ(histogram.quantile((i + 1) / 128.0), Duration{i}) << i;
    }
}

TEST(Histogram, KeepsTheLargestValueExactly)
{
    DurationHistogram histogram;
    histogram.add(1234567ns);
    EXPECT_EQ(histogram.max(), 1234567ns);
    EXPECT_EQ(histogram.quantile(1.0), 1234567ns);
    EXPECT_EQ(histogram.quantile(0.001), 1234567ns);
}

TEST(Histogram, CountsWhatIsLongerThanALimit)
{
    DurationHistogram histogram;
    for (const auto value : {0ns, 100ns, 999'999ns, 1'000'000ns, 5'000'000ns}) histogram.add(value);
    EXPECT_EQ(histogram.count_above(-1ns), 5U);
    EXPECT_EQ(histogram.count_above(0ns), 4U);
    EXPECT_EQ(histogram.count_above(99ns), 4U);
    EXPECT_EQ(histogram.count_above(100ns), 3U);
    EXPECT_EQ(histogram.count_above(4'999'999ns), 1U);
    EXPECT_EQ(histogram.count_above(5'000'000ns), 0U);
}

TEST(Histogram, IsAssignedWhole)
{
    DurationHistogram low;
    DurationHistogram high;
    for (int i = 1; i < 100; ++i) {
        low.add(i * 1us);
        high.add(i * 1s);
    }
    SnapshotHistogram copy;
    copy.assign(low);
    EXPECT_EQ(copy.quantile(0.5), low.quantile(0.5));
    EXPECT_EQ(copy.count(), low.count());
    EXPECT_LT(copy.filled_bytes(), 4000U);
    copy.assign(high); // over what was there
    EXPECT_EQ(copy.quantile(0.01), high.quantile(0.01));
    EXPECT_EQ(copy.filled_bins().size(), high.filled_bins().size());
    copy.add(low);
    EXPECT_EQ(copy.count(), low.count() + high.count());
    EXPECT_EQ(copy.quantile(0.01), low.quantile(0.02));
    EXPECT_EQ(copy.min(), 1us);
    EXPECT_EQ(copy.max(), 99s);
    copy = SnapshotHistogram{};
    EXPECT_EQ(copy.count(), 0U);
    EXPECT_TRUE(copy.filled_bins().empty());
    copy.add(3ms);
    EXPECT_EQ(copy.quantile(0.5), 3ms);
}

TEST(Histogram, CountsNegativeDurationsAsZero)
{
    DurationHistogram histogram;
    histogram.add(-5ms);
    EXPECT_EQ(histogram.count(), 1U);
    EXPECT_EQ(histogram.quantile(0.5), 0ns);
    EXPECT_EQ(histogram.min(), 0ns);
    EXPECT_EQ(histogram.max(), 0ns);
}

TEST(Histogram, CountsWhatIsBeyondAnHourInItsLastBin)
{
    DurationHistogram histogram;
    histogram.add(1ms);
    histogram.add(Duration::max());
    EXPECT_EQ(histogram.count(), 2U);
    EXPECT_EQ(histogram.max(), Duration::max());
    EXPECT_GE(histogram.quantile(1.0), 1h);
}

TEST(Histogram, StillTellsAnHourFromHalfAnHour)
{
    DurationHistogram histogram;
    histogram.add(30min);
    histogram.add(1h);
    EXPECT_LT(histogram.quantile(0.5), 31min);
    EXPECT_EQ(histogram.quantile(1.0), 1h);
}

TEST(HistogramDeathTest, AQuantileOutsideZeroToOneIsOurMistake)
{
    const DurationHistogram histogram;
    EXPECT_DEATH(std::ignore = histogram.quantile(0.0), "must never happen");
    EXPECT_DEATH(std::ignore = histogram.quantile(1.1), "must never happen");
}

TEST(DurationHistogram, GivesTheBinsThatHoldSomething)
{
    DurationHistogram histogram;
    EXPECT_TRUE(histogram.filled_bins().empty());
    for (const int value : {0, 5, 5, 1'000'000}) histogram.add(Duration{value});
    const auto bins = histogram.filled_bins();
    ASSERT_EQ(bins.size(), 3U);
    EXPECT_EQ(bins[0].low, Duration{0});
    EXPECT_EQ(bins[0].high, Duration{1});
    EXPECT_EQ(bins[1].low, Duration{5});
    EXPECT_EQ(bins[1].count, 2U);
    EXPECT_LE(bins[2].low, Duration{1'000'000});
    EXPECT_GT(bins[2].high, Duration{1'000'000});
    EXPECT_LE((bins[2].high - bins[2].low).count(), 1'000'000 / 64 + 1);
}

} // namespace
} // namespace hapnet::base
