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
    const auto rows = read_trace_rows(text, measure, *named);
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
        read_trace_rows(text, Measure::delay, *parse_columns("time=stamp:s, delay=rtt:ms"));
    ASSERT_TRUE(delays);
    EXPECT_EQ(delays->delays(), (std::vector<base::Duration>{80ms, 90ms}));
    EXPECT_EQ(delays->times, (std::vector<base::Duration>{0s, 1s}));
    const auto rates = read_trace_rows(text, Measure::rate, *parse_columns("rate=capacity_Mbps"));
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
              "line 1: no column is named rate_bps, rate_kbps, rate_Mbps or rate_Gbps");
    EXPECT_EQ(error_of("loss\n1.5\n", Measure::loss), "line 2: loss 1.5 is more than all");
    EXPECT_EQ(error_of("rate_bps\n-\n", Measure::rate), "line 2: rate_bps '-' is not a number");
    EXPECT_EQ(error_of("t_s,rate_bps\n0,1\n2000000,1\n", Measure::rate),
              "line 3: t_s 2000000 is more than 10^6 s from the first one");
}

} // namespace
} // namespace hapnet::emulator
