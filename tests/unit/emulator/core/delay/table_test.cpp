// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/table.hpp"
#include "emulator/core/delay/trace.hpp"

#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <string>

namespace hapnet::emulator {
namespace {

using namespace std::chrono_literals;

template <typename T>
std::string error_of(const base::Result<T>& result)
{
    return result ? "accepted" : result.error().message;
}

TEST(QuantileTable, RunsInStraightLinesThroughItsSortedValues)
{
    const QuantileTable table{{30.0, 10.0, 20.0}, QuantileTable::Unit::own};
    EXPECT_EQ(table.quantile(0.0), 10.0);
    EXPECT_EQ(table.quantile(0.25), 15.0);
    EXPECT_EQ(table.quantile(0.5), 20.0);
    EXPECT_EQ(table.quantile(1.0), 30.0);
    EXPECT_EQ(table.mean(), 20.0);
    EXPECT_NEAR(table.sd(), 20.0 / std::sqrt(12.0), 1e-14); // uniform
}

TEST(QuantileTable, OfOneValueIsThatValue)
{
    const QuantileTable table{{7.0}, QuantileTable::Unit::nanoseconds};
    EXPECT_EQ(table.quantile(0.3), 7.0);
    EXPECT_EQ(table.mean(), 7.0);
    EXPECT_EQ(table.sd(), 0.0);
}

TEST(ParseDist, ReadsTheFormatOfNetem)
{
    const auto table =
        parse_dist("# This is the distribution table\n -32768 -28307\n\n0 8192 4096\n");
    ASSERT_TRUE(table) << error_of(table);
    EXPECT_EQ(**table, (QuantileTable{{-32768, -28307, 0, 4096, 8192}, QuantileTable::Unit::own}));
    EXPECT_FALSE((*table)->holds_delays());
}

TEST(ParseDist, RefusesTheRestAndNamesTheLine)
{
    EXPECT_EQ(error_of(parse_dist("1 2\n# x\n3 4.5\n")), "line 3: '4.5' is not a whole number");
    EXPECT_EQ(error_of(parse_dist("1\n2 99999999999")),
              "line 2: '99999999999' is not a whole number");
    EXPECT_EQ(error_of(parse_dist("# only\n")),
              "line 1: the file ends without two numbers that differ");
    EXPECT_EQ(error_of(parse_dist("5 5\n5\n")),
              "line 2: the file ends without two numbers that differ");
}

TEST(ParseSamples, ReadsOneDelayPerLine)
{
    const auto table = parse_samples("# measured\n12.5ms\r\n  80us\n\n0\n1s");
    ASSERT_TRUE(table) << error_of(table);
    EXPECT_EQ(**table, (QuantileTable{{0, 80e3, 12.5e6, 1e9}, QuantileTable::Unit::nanoseconds}));
    EXPECT_TRUE((*table)->holds_delays());
}

TEST(ParseSamples, ReadsTheColumnOfACsvFile)
{
    const auto table = parse_samples("\xEF\xBB\xBFsequence,delay_us,note\n1, 100,a\n2,2.5e2 ,b\n");
    ASSERT_TRUE(table) << error_of(table);
    EXPECT_EQ(**table, (QuantileTable{{100e3, 250e3}, QuantileTable::Unit::nanoseconds}));
}

TEST(ParseSamples, RefusesTheRestAndNamesTheLine)
{
    const auto error = [](std::string_view text) { return error_of(parse_samples(text)); };
    EXPECT_EQ(error("1ms\n\n12\n"), "line 3: '12' has no unit: write 12ms in each line, or say "
                                    "columns \"delay=1:ms\"");
    EXPECT_EQ(error("1ms\n-2ms"), "line 2: '-2ms' is not a duration: write a number and its unit, "
                                  "such as 160ms, 15us or 1.5s");
    EXPECT_EQ(error("1ms,2ms"),
              "line 1: no column is named delay_ns, delay_us, delay_ms or delay_s: rename one, or "
              "say which it is, such as columns \"delay=2ms:ms\"");
    EXPECT_EQ(error("delay_ms,delay_us\n1,2"), "line 1: two columns of delay");
    EXPECT_EQ(error("delay_ms\n1\nfast\n"), "line 3: delay_ms 'fast' is not a number");
    EXPECT_EQ(error("delay_ms\ninf\n"), "line 2: delay_ms 'inf' is not a number");
    EXPECT_EQ(error("delay_ms\n-3\n"), "line 2: delay_ms -3 is negative");
    EXPECT_EQ(error("delay_s\n1000001\n"), "line 2: delay_s 1000001 is longer than 10^6 s");
    EXPECT_EQ(error("a,delay_s\n1\n"), "line 2: 1 cell where the header has 2");
    EXPECT_EQ(error(""), "line 1: the file ends without a delay");
    EXPECT_EQ(error("delay_ms\n"), "line 1: the file ends without a delay");
}

TEST(ParseSamples, TakesMillionsOfValuesAndAtMostTen)
{
    std::string text;
    for (int i = 0; i < 1'500'000; ++i) text += "1s\n";
    EXPECT_TRUE(parse_samples(text));
    for (std::size_t i = 1'500'000; i < QuantileTable::values_max; ++i) text += "1s\n";
    EXPECT_EQ(error_of(parse_samples(text + "1s\n")),
              "line 10000001: " + std::string{too_many_values});
}

TEST(DelayTrace, ByPacketGivesValueNToDatagramNAndBeginsAgain)
{
    const auto trace = parse_delay_trace("10ms\n30ms\n20ms\n");
    ASSERT_TRUE(trace) << error_of(trace);
    for (std::uint64_t n = 0; n < 9; n += 3) {
        EXPECT_EQ((*trace)->of(n), 10ms);
        EXPECT_EQ((*trace)->of(n + 1), 30ms);
        EXPECT_EQ((*trace)->of(n + 2), 20ms);
    }
    EXPECT_EQ((*trace)->share(1), 1.0 / 3.0);
}

TEST(DelayTrace, ByTimeHoldsAValueUntilTheNextAndTheLastAsLongAsTheOneBefore)
{
    const auto trace = parse_delay_trace("delay_ms,time_s\n10,0\n30,1\n20,3\n");
    ASSERT_TRUE(trace) << error_of(trace);
    for (const base::Duration round : {0s, 5s, 5'000'000s}) {
        const auto at = [&](base::Duration time) { return (*trace)->at(round + time); };
        EXPECT_EQ(at(0s), 10ms);
        EXPECT_EQ(at(1s - 1ns), 10ms);
        EXPECT_EQ(at(1s), 30ms);
        EXPECT_EQ(at(3s - 1ns), 30ms);
        EXPECT_EQ(at(3s), 20ms);
        EXPECT_EQ(at(5s - 1ns), 20ms);
    }
    EXPECT_EQ((*trace)->share(0), 0.2);
    EXPECT_EQ((*trace)->share(2), 0.4);
}

TEST(DelayTrace, ByTimeGoesToTheNextValueInAStraightLine)
{
    const auto trace = *parse_delay_trace("t_ms,delay_ms\n0,10\n10,30\n30,20\n");
    const auto at = [&](base::Duration time, bool repeats) {
        return trace->at(time, Interpolation::linear, repeats);
    };
    for (const bool repeats : {false, true}) {
        EXPECT_EQ(at(0ms, repeats), 10ms);
        EXPECT_EQ(at(5ms, repeats), 20ms);
        EXPECT_EQ(at(20ms, repeats), 25ms);
        EXPECT_EQ(at(30ms, repeats), 20ms);
    }
    EXPECT_EQ(at(40ms, true), 15ms); // on the way back to the first one
    EXPECT_EQ(at(40ms, false), 20ms);
    EXPECT_EQ(at(1h, false), 20ms);
}

TEST(DelayTrace, CountsTimesFromTheFirstOne)
{
    EXPECT_EQ(**parse_delay_trace("time_s,delay_ms\n1700000000,10\n1700000002.5,20\n"),
              **parse_delay_trace("time_s,delay_ms\n0,10\n2.5,20\n"));
}

TEST(DelayTrace, GivesALostPingTheDelayOfItsNeighbour)
{
    EXPECT_EQ((*parse_delay_trace("delay_ms\n-\n10\nNaN\n20\ntimeout\n"))->delays(),
              (std::vector<base::Duration>{10ms, 10ms, 10ms, 20ms, 20ms}));
    EXPECT_EQ(error_of(parse_delay_trace("delay_ms,x\nlost,1\n")),
              "line 2: the file ends without a delay");
}

TEST(DelayTrace, WithoutRepetitionEndsAtItsLastValue)
{
    const auto trace = *parse_delay_trace("10ms\n30ms\n");
    EXPECT_EQ(trace->of(1, false), 30ms);
    EXPECT_EQ(trace->of(2, false), 30ms);
}

TEST(TraceLaw, BeginsWithTheFirstDatagramAtItsOffsetAndGoesOnThroughAChange)
{
    TraceLaw law{"x", *parse_delay_trace("t_ms,delay_ms\n0,10\n10,30\n20,20\n")};
    law.timing = {.offset = 5ms, .start = TraceStart::first};
    ASSERT_TRUE(law.validate());
    TraceLaw::Sampler sampler{law};
    EXPECT_EQ(sampler.at({0, 96, 1s}), 10ms);
    EXPECT_EQ(sampler.at({1, 96, 1s + 5ms}), 30ms);
    sampler.change(law);
    EXPECT_EQ(sampler.at({2, 96, 1s + 15ms}), 20ms);
    law.timing.offset = 0ms;
    sampler.change(law); // a new trace starts from its beginning
    EXPECT_EQ(sampler.at({3, 96, 2s}), 10ms);
}

TEST(TraceLaw, HasTheMomentsOfItsStraightLines)
{
    TraceLaw law{"x", *parse_delay_trace("t_ms,delay_ms\n0,0\n10,12\n20,0\n30,12\n")};
    law.interpolate = Interpolation::linear;
    EXPECT_EQ(law.moments().mean, 6ms);
    // The sd of a uniform law, less 1 / 16^2 of its variance, which steps lack.
    EXPECT_NEAR(base::to_nanoseconds(*law.moments().sd), 12e6 / std::sqrt(12.0), 0.01e6);
    EXPECT_EQ(law.steps().back().share, 1.0);
}

TEST(TraceLaw, RefusesTimesForAValueOfEachDatagram)
{
    TraceLaw law{"x", *parse_delay_trace("10ms\n30ms\n")};
    EXPECT_TRUE(law.validate());
    law.timing.start = TraceStart::first;
    EXPECT_EQ(law.validate().error().message,
              "offset, start and interpolate need a column of times, or a slot: this trace has a "
              "value for each datagram");
}

TEST(DelayTrace, OfOneValueHoldsItForEver)
{
    const auto trace = parse_delay_trace("time_ms,delay_ms\n0,10\n");
    ASSERT_TRUE(trace) << error_of(trace);
    EXPECT_EQ((*trace)->at(1'000s), 10ms);
}

TEST(DelayTrace, RefusesTimesThatDoNotAscendAndNamesTheLine)
{
    const auto error = [](std::string_view text) { return error_of(parse_delay_trace(text)); };
    EXPECT_EQ(error("time_s,delay_ms\n0,10\n2,10\n2,10"), "line 4: 2s is not later than 2s");
    EXPECT_EQ(error("time_s,delay_ms\n0,10\n-1,10"), "line 3: time_s -1 is negative");
    EXPECT_EQ(error("time_s,time_ms,delay_ms\n"), "line 1: two columns of time");
}

} // namespace
} // namespace hapnet::emulator
