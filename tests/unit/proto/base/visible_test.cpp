// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/visible.hpp"

#include "proto/base/reading.hpp"

#include <gtest/gtest.h>
#include <string>

namespace hapnet::base {

TEST(Visible, LeavesTextOfAnyLanguageAsItIs)
{
    for (const char* text : {"", "lab", "a \\ b", "Übung 4 µs → 5", "手", "\U0001F9CA"}) {
        EXPECT_EQ(visible(text), text);
        EXPECT_EQ(visible_lines(text), text);
    }
}

TEST(Visible, ShowsWhatATerminalWouldObey)
{
    EXPECT_EQ(visible("\x1b]0;title\x07"), "\\u001B]0;title\\u0007");
    EXPECT_EQ(visible("a\u202eb\u2066c\u200fd"), "a\\u202Eb\\u2066c\\u200Fd");
    EXPECT_EQ(visible("a\nb\rc\td\x7f"), "a\\u000Ab\\u000Dc\\u0009d\\u007F");
    EXPECT_EQ(visible("\xc2\x9b"
                      "31m"),
              "\\u009B31m"); // the same command in one character
    EXPECT_EQ(visible(std::string_view{"\0", 1}), "\\u0000");
}

TEST(Visible, ShowsBytesThatAreNotUtf8)
{
    EXPECT_EQ(visible("\x9b"
                      "31m"),
              "\\x9B31m");
    EXPECT_EQ(visible("\xc3"), "\\xC3");                   // cut off
    EXPECT_EQ(visible("\xc0\xaf"), "\\xC0\\xAF");          // an overlong encoding
    EXPECT_EQ(visible("\xed\xa0\x80"), "\\xED\\xA0\\x80"); // half of a surrogate pair
    EXPECT_EQ(visible("\xf5\x80\x80\x80"), "\\xF5\\x80\\x80\\x80");
}

TEST(Visible, KeepsEndsOfLinesAndTabsWhereTextHasLines)
{
    EXPECT_EQ(visible_lines("a\n\tb\n"), "a\n\tb\n");
    EXPECT_EQ(visible_lines("a\n\x1b[2J\r"), "a\n\\u001B[2J\\u000D");
}

TEST(Visible, HoldsInQuotationsOfComplaints)
{
    EXPECT_EQ(in_quotes("a\\b\x1b\xc2\x9b"), "'a\\\\b\\u001B\\u009B'");
}

} // namespace hapnet::base
