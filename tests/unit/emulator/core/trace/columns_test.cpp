// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/trace/columns.hpp"

#include <gtest/gtest.h>

namespace hapnet::emulator {
namespace {

TEST(WrittenNumber, HasAPointOrACommaAndOneOfThem)
{
    EXPECT_EQ(number_in("20.5")->value, 20.5);
    EXPECT_EQ(number_in("20.5")->mark, '.');
    EXPECT_EQ(number_in("20,5")->value, 20.5);
    EXPECT_EQ(number_in("20,5")->mark, ',');
    EXPECT_EQ(number_in("1e3")->value, 1000.0);
    EXPECT_EQ(number_in("1e3")->mark, '\0');
    for (const char* wrong : {"", "1.234,5", "1,234,567", "5ms", "nan", "inf", "1 2", "0x10"}) {
        EXPECT_FALSE(number_in(wrong)) << wrong;
    }
}

TEST(LostWords, AreFew)
{
    for (const char* word : {"", "NaN", "-", "*", "LOST", "timeout"}) EXPECT_TRUE(says_lost(word));
    for (const char* word : {"0", "lost2", "timeouts", "n/a"}) EXPECT_FALSE(says_lost(word));
}

TableLayout layout_of(std::string_view text, Measure measure, std::string_view columns = "")
{
    return find_layout(LineReader{text}, measure, parse_columns(columns).value()).value();
}

TEST(TableLayout, HasTheSeparatorThatShowsTheColumns)
{
    EXPECT_EQ(layout_of("t_s,delay_ms\n", Measure::delay).separator, ',');
    EXPECT_EQ(layout_of("t_s;delay_ms;note, if any\n", Measure::delay).separator, ';');
    EXPECT_EQ(layout_of("t_s\tdelay_ms\n", Measure::delay).separator, '\t');
    EXPECT_EQ(layout_of("t_s  delay_ms\n", Measure::delay).separator, ' ');
    EXPECT_EQ(layout_of("t_s, delay_ms\n", Measure::delay).separator, ',');
    EXPECT_TRUE(layout_of("t_s, delay_ms\n", Measure::delay).time.has_value());
}

TEST(TableLayout, FindsColumnsByNumberWhereThereIsNoHeader)
{
    const auto rates = layout_of("0.5 1.21\n", Measure::rate, "time=1:s, rate=2:Mbps");
    EXPECT_FALSE(rates.has_header);
    EXPECT_EQ(rates.separator, ' ');
    EXPECT_EQ(rates.value->place, 1U);
    EXPECT_EQ(rates.value->factor, 1e6);
    EXPECT_EQ(rates.time->place, 0U);
    EXPECT_EQ(layout_of("0,5 20,5\n", Measure::delay, "time=1:s,delay=2:ms").separator, ' ');
    EXPECT_TRUE(layout_of("when,how long\n", Measure::delay, "delay=2:ms").has_header);
}

} // namespace
} // namespace hapnet::emulator
