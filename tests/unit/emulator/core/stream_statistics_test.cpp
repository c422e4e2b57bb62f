// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/stream_statistics.hpp"

#include "tests/unit/emulator/core/passage.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace hapnet::emulator::stream_statistics_test {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{1h};

/// Number n arrives at n ms.
Passage passage(std::uint64_t number, base::Duration sent, bool is_copy = false)
{
    return {number, start + number * 1ms, start + sent, is_copy};
}

StreamReport report_of(const std::vector<Passage>& passages)
{
    StreamStatistics measured;
    for (const Passage& one : passages) note(measured, one);
    return measured.report();
}

TEST(StreamStatistics, HasNothingToSayOfNothing)
{
    const StreamReport report = StreamStatistics{}.report();
    EXPECT_FALSE(report.requested_delay);
    EXPECT_FALSE(report.delay);
    EXPECT_FALSE(report.delay_quantiles);
    EXPECT_FALSE(report.delay_variation);
    EXPECT_FALSE(report.gap);
    EXPECT_FALSE(report.clumped_share);
    EXPECT_FALSE(report.missing_runs.mean());
    EXPECT_FALSE(report.reordered.mean());
    EXPECT_FALSE(report.age.mean);
    EXPECT_FALSE(report.age.peak_mean);
    EXPECT_FALSE(report.age.peak_max);
}

TEST(StreamStatistics, OfOneDepartureHasADelayAndNoVariation)
{
    const StreamReport report = report_of({passage(0, 10ms)});
    EXPECT_EQ(report.delay->mean, 10ms);
    EXPECT_EQ(report.delay->sd, std::nullopt);
    EXPECT_FALSE(report.delay_variation);
    EXPECT_FALSE(report.gap);
    EXPECT_FALSE(report.age.mean);
}

TEST(StreamStatistics, ComparesTheLawThatWasDrawnWithTheOneThatCameOut)
{
    StreamStatistics measured;
    measured.on_packet({.delay = 10ms}, start);
    measured.on_packet({.drop = DropCause::random_loss}, start);
    measured.on_packet({.delay = 12ms}, start);
    note(measured, passage(0, 10ms));
    note(measured, passage(2, 16ms));
    const StreamReport report = measured.report();
    EXPECT_EQ(report.requested_delay->mean, 11ms);
    EXPECT_EQ(report.requested_delay->sd, 1'414'214ns);
    EXPECT_EQ(report.delay->mean, 12ms);
    EXPECT_EQ(report.delay->sd, 2'828'427ns);
    EXPECT_EQ(report.delay_variation->max, 4ms);
    EXPECT_EQ(report.gap->max, 6ms);
}

TEST(StreamStatistics, CallsDeparturesAClumpThatFollowEachOtherWithin50Microseconds)
{
    const StreamReport report =
        report_of({passage(0, 10ms), passage(1, 11ms), passage(2, 11ms + 50us),
                   passage(3, 11ms + 99us), passage(4, 20ms)});
    EXPECT_EQ(report.clumped_share, 0.25);
}

TEST(StreamStatistics, CountsRunsOfMissingUpdatesBetweenInOrderDepartures)
{
    // 0 is missing at first. Later 2, 3 and 4 are, of which 3 arrives too late to matter.
    const StreamReport report =
        report_of({passage(1, 10ms), passage(5, 15ms), passage(3, 16ms), passage(6, 17ms)});
    EXPECT_EQ(report.missing_runs.count, 2U);
    EXPECT_EQ(report.missing_runs.mean(), 2.0);
    EXPECT_EQ(report.missing_runs.max, 3U);
}

TEST(StreamStatistics, MeasuresHowFarAReorderedDepartureCameAfterTheFirstOneThatOvertookIt)
{
    // 2 comes three departures after 4, and 3 comes four after it.
    const StreamReport report =
        report_of({passage(1, 10ms), passage(4, 15ms), passage(5, 15ms), passage(6, 15ms),
                   passage(2, 15ms), passage(3, 15ms), passage(7, 16ms)});
    EXPECT_EQ(report.reordered.count, 2U);
    EXPECT_EQ(report.reordered.mean(), 3.5);
    EXPECT_EQ(report.reordered.max, 4U);
    EXPECT_EQ(report.beyond_look_back, 0U);
}

TEST(StreamStatistics, LooksBackOnlySoFar)
{
    StreamStatistics measured;
    for (std::uint64_t n = 1; n <= 2000; ++n) note(measured, passage(n, 2s));
    note(measured, passage(0, 2s));
    EXPECT_EQ(measured.report().reordered.max, base::ReorderExtents::looks_back);
    EXPECT_EQ(measured.report().beyond_look_back, 1U);
}

TEST(StreamStatistics, TakesTheAgeOfInformationFromTheNewestUpdateThatHasDeparted)
{
    // Arrivals at 0, 1, 2, 5 ms. Age 4 ms at 4 ms; 1 ms later it peaks at 5 and falls to 3 (number
    // 2); number 1 is old news; at 9 ms it peaks at 7 and falls to 4 (number 5).
    const StreamReport report =
        report_of({passage(0, 4ms), passage(2, 5ms), passage(1, 6ms), passage(5, 9ms)});
    EXPECT_EQ(report.age.peak_max, 7ms);
    EXPECT_EQ(report.age.peak_mean, 6ms);
    // (1 ms at 4.5 on average + 4 ms at 5 on average) / 5 ms
    EXPECT_EQ(report.age.mean, 4'900'000ns);
}

TEST(StreamStatistics, TakesNoNoticeOfCopies)
{
    const StreamReport report = report_of(
        {passage(0, 10ms), passage(0, 10ms, true), passage(1, 11ms), passage(0, 12ms, true)});
    EXPECT_EQ(report.clumped_share, 0.0);
    EXPECT_EQ(report.reordered.count, 0U);
    EXPECT_EQ(report.gap->max, 1ms);
}

} // namespace
} // namespace hapnet::emulator::stream_statistics_test
