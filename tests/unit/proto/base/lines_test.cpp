// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/lines.hpp"

#include <gtest/gtest.h>
#include <string>

namespace hapnet::base {
namespace {

using namespace std::string_literals;

TEST(PlainText, IsMadeOfUtf16InEitherByteOrder)
{
    // "Zähl" and a musical clef, which takes two units.
    EXPECT_EQ(plain_text("\xff\xfeZ\0\xe4\0h\0l\0\x34\xd8\x1e\xdd"s).value(), "Zähl𝄞");
    EXPECT_EQ(plain_text("\xfe\xff\0Z\0\xe4\xd8\x34\xdd\x1e"s).value(), "Zä𝄞");
    EXPECT_EQ(plain_text("\xff\xfe\x34\xd8Z"s).value(), "\xef\xbf\xbd"); // half a pair, half a unit
    EXPECT_EQ(plain_text("delay_ms\n1\n").value(), "delay_ms\n1\n");
}

TEST(PlainText, IsNotReadOfACompressedFileButSaysHowToUnpackIt)
{
    EXPECT_EQ(plain_text("\x1f\x8b\x08\0"s).error().message,
              "the file is compressed (gzip): unpack it first, for example with gunzip -k");
    EXPECT_EQ(plain_text("\x28\xb5\x2f\xfd"s).error().message,
              "the file is compressed (zstd): unpack it first, for example with unzstd");
    EXPECT_EQ(plain_text("PK\x03\x04"s).error().message,
              "the file is compressed (zip): unpack it first, for example with unzip");
}

TEST(LineNumberAt, CountsFromOneAndStaysWithinTheText)
{
    EXPECT_EQ(line_number_at("", 0), 1U);
    EXPECT_EQ(line_number_at("a\nb", 1), 1U); // a line end belongs to its line
    EXPECT_EQ(line_number_at("a\nb", 2), 2U);
    EXPECT_EQ(line_number_at("a\nb\n", 99), 3U);
}

TEST(LineReader, CountsTheLinesThatItPassesOver)
{
    LineReader lines{"\xEF\xBB\xBF# a\n\n one \r\n \t\ntwo"};
    EXPECT_EQ(lines.next(), "one");
    EXPECT_EQ(lines.number(), 3U);
    EXPECT_EQ(lines.next(), "two");
    EXPECT_EQ(lines.fail("x").value().message, "line 5: x");
    EXPECT_FALSE(lines.next());
}

TEST(LineReader, CountsTheLinesWithinQuotes)
{
    LineReader lines{"a,\"b\nc\"\n1,2\n\"open"};
    Cells cells{{',', true}};
    EXPECT_EQ((*lines.next_cells(cells))->size(), 2U);
    EXPECT_EQ(lines.number(), 1U);
    EXPECT_EQ((*lines.next_cells(cells))->front(), "1");
    EXPECT_EQ(lines.number(), 3U);
    EXPECT_EQ(lines.next_cells(cells).error().message.rfind("line 4: a quote is open", 0), 0U);
}

TEST(Shortened, ShowsNothingThatATerminalWouldAct)
{
    EXPECT_EQ(shortened("f\x81r \x1b[2J"), "f\\x81r \\u001B[2J");
    // A character is never cut.
    EXPECT_EQ(shortened(std::string(39, 'a') + "ü" + "b"), std::string(39, 'a') + "...");
}

} // namespace
} // namespace hapnet::base
