// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/trace/columns.hpp"

#include <gtest/gtest.h>

namespace hapnet::emulator {
namespace {

base::TableLayout layout_of(std::string_view text, Measure measure, std::string_view columns = "")
{
    return find_layout(base::LineReader{text}, measure, parse_columns(columns).value()).value();
}

TEST(TableLayout, HasTheSeparatorThatShowsTheColumns)
{
    EXPECT_EQ(layout_of("t_s,delay_ms\n", Measure::delay).separator, ',');
    EXPECT_EQ(layout_of("t_s;delay_ms;note, if any\n", Measure::delay).separator, ';');
    EXPECT_EQ(layout_of("t_s\tdelay_ms\n", Measure::delay).separator, '\t');
    EXPECT_EQ(layout_of("t_s  delay_ms\n", Measure::delay).separator, ' ');
    EXPECT_EQ(layout_of("t_s, delay_ms\n", Measure::delay).separator, ',');
    EXPECT_TRUE(layout_of("t_s, delay_ms\n", Measure::delay).columns[1].has_value());
}

TEST(TableLayout, FindsColumnsByNumberWhereThereIsNoHeader)
{
    const auto rates = layout_of("0.5 1.21\n", Measure::rate, "time=1:s, rate=2:Mbps");
    EXPECT_FALSE(rates.has_header);
    EXPECT_EQ(rates.separator, ' ');
    EXPECT_EQ(value_of(rates)->place, 1U);
    EXPECT_EQ(value_of(rates)->factor, 1e6);
    EXPECT_EQ(time_column(rates)->place, 0U);
    EXPECT_EQ(layout_of("0,5 20,5\n", Measure::delay, "time=1:s,delay=2:ms").separator, ' ');
    EXPECT_TRUE(layout_of("when,how long\n", Measure::delay, "delay=2:ms").has_header);
}

} // namespace
} // namespace hapnet::emulator
