// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/cells.hpp"

#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace hapnet::base {
namespace {

using Lines = std::vector<std::vector<std::string>>;

/// All lines of a text; an empty list if the text is refused.
Lines lines_of(std::string_view text, CellStyle style)
{
    Lines lines;
    Cells cells{style};
    while (!text.empty()) {
        if (!cells.take_line(text)) {
            lines.emplace_back();
            return lines;
        }
        lines.emplace_back(cells.all().begin(), cells.all().end());
    }
    return lines;
}

TEST(Cells, StandInQuotesWithSeparatorsLineEndsAndDoubledQuotes)
{
    EXPECT_EQ(lines_of("a,\"b,\"\"c\"\"\nd\"\r\n,\n", {}), (Lines{{"a", "b,\"c\"\nd"}, {"", ""}}));
    EXPECT_EQ(lines_of("a\"b,c\n", {}), (Lines{{"a\"b", "c"}}));
    std::string_view text = "\"a\nb\"\nc";
    Cells cells{{}};
    EXPECT_TRUE(cells.take_line(text));
    EXPECT_EQ(cells.lines(), 2U);
    EXPECT_EQ(text, "c");
}

TEST(Cells, RefuseAQuoteThatIsOpenOrHasTextBehindIt)
{
    EXPECT_EQ(lines_of("\"a", {}), (Lines{{}}));
    EXPECT_EQ(lines_of("\"a\"b,c", {}), (Lines{{}}));
    EXPECT_EQ(lines_of("\"a\"b c", {' ', true}), (Lines{{}}));
}

TEST(Cells, KeepBlanksUnlessTheyAreTrimmed)
{
    EXPECT_EQ(lines_of(" a , b\r\n", {}), (Lines{{" a ", " b"}}));
    EXPECT_EQ(lines_of(" a ;\t\"b\" ; \r\n", {';', true}), (Lines{{"a", "b", ""}}));
    EXPECT_EQ(lines_of("a\t\t b \n", {'\t', true}), (Lines{{"a", "", "b"}}));
}

TEST(Cells, AreSeparatedByAsManyBlanksAsThereAre)
{
    EXPECT_EQ(lines_of("  1 \t 2\t\"3 4\" \r\n5\n", {' ', true}),
              (Lines{{"1", "2", "3 4"}, {"5"}}));
}

} // namespace
} // namespace hapnet::base
