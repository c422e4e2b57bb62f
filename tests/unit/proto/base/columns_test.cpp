// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/columns.hpp"

#include <array>
#include <gtest/gtest.h>

namespace hapnet::base {
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

constexpr std::array<ColumnUnit, 2> lengths{{{"m", 1.0}, {"mm", 1e-3}}};
constexpr std::array kinds{
    ColumnKind{.what = "x",
               .units = lengths,
               .bare_factor = 0.5,
               .most = 10.0,
               .usual_names = "x_m",
               .example_unit = ":m"},
    ColumnKind{
        .what = "y", .units = lengths, .most = 10.0, .usual_names = "y_m", .example_unit = ":m"},
    ColumnKind{.what = "z", .units = lengths, .is_optional = true}};
constexpr std::array<std::string_view, 3> known{"x", "y", "z"};

TEST(TableLayout, HasAColumnOfEachKindInTheirOrder)
{
    const auto layout = find_layout(LineReader{"y_mm\tn\tx\n1\t2\t3\n"}, kinds, {}).value();
    EXPECT_EQ(layout.separator, '\t');
    EXPECT_TRUE(layout.has_header);
    ASSERT_EQ(layout.columns.size(), 3U);
    EXPECT_EQ(layout.columns[0]->place, 2U);
    EXPECT_EQ(layout.columns[0]->factor, 0.5);
    EXPECT_EQ(layout.columns[1]->place, 0U);
    EXPECT_EQ(layout.columns[1]->factor, 1e-3);
    EXPECT_FALSE(layout.columns[2]);
}

TEST(TableLayout, SaysWhichColumnIsMissing)
{
    const auto refusal = [](std::string_view text, std::string_view columns) {
        return find_layout(LineReader{text}, kinds, parse_columns(columns, known).value())
            .error()
            .message;
    };
    EXPECT_EQ(refusal("x,b\n", ""), "no column is named y_m: rename one, or say which it is, such "
                                    "as columns \"y=b:m\"");
    EXPECT_EQ(refusal("x,b\n", "y=c:m"), "no column is named 'c'");
    EXPECT_EQ(refusal("x,b\n", "y=b"), "column 'b' has no unit: write y=b:UNIT with one of m, mm");
    EXPECT_EQ(parse_columns("w=b", known).error().message,
              "'w=b' names no column: write x=NAME:UNIT, and likewise y or z");
}

} // namespace
} // namespace hapnet::base
