// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/trace/rows.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace hapnet::emulator {
namespace {

using namespace std::chrono_literals;

std::string error_of(std::string_view text, Measure measure, std::string_view columns = "")
{
    const auto named = parse_columns(columns);
    if (!named) return named.error().message;
    const auto rows = read_trace_rows(text, measure, {*named});
    return rows ? "accepted" : rows.error().message;
}

TEST(TraceRows, FindsTheColumnsAndUnitsOfAMeasure)
{
    const auto rows = read_trace_rows("t_s,rate_kbps,x\n0,100,a\n0.5,2.5,b\n", Measure::rate);
    ASSERT_TRUE(rows);
    EXPECT_EQ(rows->values, (std::vector{100e3, 2500.0}));
    EXPECT_EQ(rows->times, (std::vector<base::Duration>{0s, 500ms}));
    EXPECT_EQ(read_trace_rows("loss\n0.25\n", Measure::loss)->values, std::vector{0.25});
    EXPECT_EQ(read_trace_rows("loss_percent\n25\n", Measure::loss)->values, std::vector{0.25});
}

TEST(TraceRows, ReadsTheColumnsThatAPersonNames)
{
    const std::string text = "stamp,rtt,capacity_Mbps\n10,80,2\n11,90,3\n";
    const auto delays =
        read_trace_rows(text, Measure::delay, {*parse_columns("time=stamp:s, delay=rtt:ms")});
    ASSERT_TRUE(delays);
    EXPECT_EQ(delays->delays(), (std::vector<base::Duration>{80ms, 90ms}));
    EXPECT_EQ(delays->times, (std::vector<base::Duration>{0s, 1s}));
    const auto rates = read_trace_rows(text, Measure::rate, {*parse_columns("rate=capacity_Mbps")});
    ASSERT_TRUE(rates);
    EXPECT_EQ(rates->values, (std::vector{2e6, 3e6}));
    EXPECT_TRUE(rates->times.empty());
}

TEST(TraceRows, MarksWhatWasLost)
{
    const auto rows = read_trace_rows("rtt_ms,delay_us\n1,5\n1,\n1,LOST\n1,6\n", Measure::delay);
    ASSERT_TRUE(rows);
    EXPECT_EQ(rows->lost, (std::vector{false, true, true, false}));
    EXPECT_EQ(rows->values, (std::vector{5e3, 5e3, 5e3, 6e3}));
}

TEST(TraceRows, TakeAnEmptyLineOfASingleColumnForALostDatagram)
{
    constexpr std::string_view text = "# walk\ndelay_ms\n\n5\n\n\r\n# b\n6\n\n";
    const auto rows = read_trace_rows(text, Measure::delay);
    ASSERT_TRUE(rows);
    EXPECT_EQ(rows->lost, (std::vector{false, true, true, false}));
    EXPECT_EQ(rows->values, (std::vector{5e6, 5e6, 5e6, 6e6}));
    const auto slots = read_trace_rows("5\n\n6\n", Measure::delay, {{}, 10ms});
    ASSERT_TRUE(slots);
    EXPECT_EQ(slots->lost, (std::vector{false, true, false}));
    EXPECT_EQ(slots->times, (std::vector<base::Duration>{0s, 10ms, 20ms}));
    const auto pairs = read_trace_rows("t_s,delay_ms\n0,5\n\n1,6\n", Measure::delay);
    ASSERT_TRUE(pairs);
    EXPECT_EQ(pairs->lost, (std::vector{false, false}));
}

TEST(TraceRows, SayWhatIsWrongWithColumns)
{
    constexpr std::string_view text = "stamp,rtt\n1,2\n";
    EXPECT_EQ(error_of(text, Measure::delay, "delay=rtt"),
              "line 1: column 'rtt' has no unit: write delay=rtt:UNIT with one of ns, us, ms, s");
    EXPECT_EQ(error_of(text, Measure::delay, "delay=rtt:h"),
              "line 1: unknown unit 'h' of delay: use one of ns, us, ms, s");
    EXPECT_EQ(error_of(text, Measure::delay, "delay=owd:ms"), "line 1: no column is named 'owd'");
    EXPECT_EQ(
        error_of(text, Measure::delay, "rtt"),
        "'rtt' names no column: write time=NAME:UNIT, and likewise delay, loss, lost or rate");
    EXPECT_EQ(error_of(text, Measure::delay, "delay=:ms"), "'delay=:ms' has no name of a column");
    EXPECT_EQ(error_of(text, Measure::rate),
              "line 1: no column is named rate_bps, rate_kbps, rate_Mbps or rate_Gbps: rename one, "
              "or say which it is, such as columns \"rate=rtt:Mbps\"");
    EXPECT_EQ(error_of("loss\n1.5\n", Measure::loss), "line 2: loss 1.5 is more than all");
    EXPECT_EQ(error_of("rate_bps\n-\n", Measure::rate), "line 2: rate_bps '-' is not a number");
    EXPECT_EQ(error_of("t_s,rate_bps\n0,1\n2000000,1\n", Measure::rate),
              "line 3: t_s 2000000 is more than 10^6 s from the first one");
}

/// A table of two rows that means the same in each way to write it.
TEST(TraceRows, AreTheSameInEachWayToWriteATable)
{
    for (const char* text :
         {"t_s,delay_ms\n0.0,30.5\n0.25,31.25\n",
          "\"t_s\",\"delay_ms\"\n\"0.0\",\"30.5\"\n\"0.25\",\"31.25\"\n",
          "t_s,place,delay_ms\n0.0,\"Ghent, \"\"port\"\"\",30.5\n0.25,\"two\nlines\",31.25\n",
          "t_s;delay_ms\r\n0,0;30,5\r\n0,25;31,25\r\n", "t_s;delay_ms\n0.0;30.5\n0.25;31.25\n",
          "\"t_s\";\"delay_ms\"\n\"0,0\";\"30,5\"\n\"0,25\";\"31,25\"\n",
          "t_s\tdelay_ms\n0.0\t30.5\n0.25\t31.25\n", "t_s delay_ms\n0.0   30.5\n0.25  31.25\n",
          "\"t_s\",\"delay_ms\"\n\"0,0\",\"30,5\"\n\"0,25\",\"31,25\"\n",
          "# by hand\n\nt_s, delay_ms\n0.0, 30.5\n0.25, 31.25"}) {
        const auto rows = read_trace_rows(text, Measure::delay);
        ASSERT_TRUE(rows) << text << rows.error().message;
        EXPECT_EQ(rows->values, (std::vector{30.5e6, 31.25e6})) << text;
        EXPECT_EQ(rows->times, (std::vector<base::Duration>{0s, 250ms})) << text;
    }
}

TEST(TraceRows, HaveADecimalCommaInAColumnThatIsAlone)
{
    EXPECT_EQ(read_trace_rows("delay_ms\n30,5\n31,25\n", Measure::delay)->values,
              (std::vector{30.5e6, 31.25e6}));
}

TEST(TraceRows, WithoutAHeaderAreNamedByNumber)
{
    constexpr std::string_view by_tabs = "0.0\t1.5\n0.5\t2.25\n";
    EXPECT_EQ(error_of(by_tabs, Measure::rate),
              "line 1: 2 columns without a header: name them by their numbers, such as columns "
              "\"time=1:s, rate=2:Mbps\"");
    for (const std::string_view text :
         {by_tabs, std::string_view{"0.0 1.5\n0.5 2.25\n"},
          std::string_view{"0.0, 1.5\n0.5, 2.25\n"}, std::string_view{"0,0;1,5\n0,5;2,25\n"}}) {
        const auto rows =
            read_trace_rows(text, Measure::rate, {*parse_columns("time=1:s, rate=2:Mbps")});
        ASSERT_TRUE(rows) << text << rows.error().message;
        EXPECT_EQ(rows->values, (std::vector{1.5e6, 2.25e6}));
        EXPECT_EQ(rows->times, (std::vector<base::Duration>{0s, 500ms}));
    }
    EXPECT_EQ(error_of("12\n", Measure::rate),
              "line 1: a column without a header: say what it is, such as columns "
              "\"rate=1:Mbps\"");
    EXPECT_EQ(error_of("1 2\n", Measure::delay, "delay=3:ms"), "line 1: no column is named '3'");
}

TEST(TraceRows, HaveTimesBySlots)
{
    const auto rows = read_trace_rows("12\nlost\n14.5\n", Measure::delay, {{}, 10ms});
    ASSERT_TRUE(rows);
    EXPECT_EQ(rows->delays(), (std::vector<base::Duration>{12ms, 12ms, 14'500us}));
    EXPECT_EQ(rows->lost, (std::vector{false, true, false}));
    EXPECT_EQ(rows->times, (std::vector<base::Duration>{0ms, 10ms, 20ms}));
    const auto rates =
        read_trace_rows("5\n6\n", Measure::rate, {*parse_columns("rate=1:Mbps"), 1s});
    EXPECT_EQ(rates->times, (std::vector<base::Duration>{0s, 1s}));
    EXPECT_EQ(read_trace_rows("t_s,delay_ms\n0,1\n", Measure::delay, {{}, 10ms}).error().message,
              "line 1: the file has times of its own: leave out slot");
}

TEST(TraceRows, RefuseWhatMayMeanTwoThings)
{
    EXPECT_EQ(error_of("20,5\n21,5\n", Measure::delay, "delay=1:ms"),
              "line 1: '20,5' may be one number with a decimal comma, or two: write a decimal "
              "point, or name the columns in a header");
    EXPECT_EQ(error_of("t_s;delay_ms\n0;20.5\n1;1,25\n", Measure::delay),
              "line 3: delay_ms '1,25' has a decimal comma where lines before it have a point: "
              "write all numbers in one way");
    EXPECT_EQ(error_of("t_s;delay_ms\n0;1.020,5\n", Measure::delay),
              "line 2: delay_ms '1.020,5' is not a number: write it without separators of "
              "thousands");
    EXPECT_EQ(error_of("t_s,delay_ms\n0,0,20,5\n", Measure::delay),
              "line 2: 4 cells where the header has 2: with decimal commas, separate cells by "
              "semicolons");
}

} // namespace
} // namespace hapnet::emulator
