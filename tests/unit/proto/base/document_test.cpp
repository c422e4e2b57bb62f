// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/document.hpp"

#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>

namespace hapnet::base {
namespace {

std::string refusal(std::string_view text)
{
    const auto document = parse_document(text);
    return document ? "read" : document.error().message;
}

TEST(Document, NamesTheFormatOfATextThatIsNotToml)
{
    for (const std::string_view text :
         {"both:\n  delay: 80ms\n", "---\nname: lte\n", "# LTE\n\ndelay: 80ms\n", "- up: 1\n"}) {
        EXPECT_EQ(refusal(text).rfind("this looks like YAML; ", 0), 0U) << refusal(text);
    }
    for (const std::string_view text : {R"({"both": {"delay": "80ms"}})", "\n {\n}"}) {
        EXPECT_EQ(refusal(text).rfind("this looks like JSON; ", 0), 0U) << refusal(text);
    }
}

TEST(Document, SaysThatAFileIsNoText)
{
    const auto says = [](std::string_view text, std::string_view words) {
        EXPECT_EQ(refusal(text).substr(0, words.size()), words) << refusal(text);
    };
    says(std::string_view{"\x7f"
                          "ELF\2\1\1\0",
                          8},
         "this is no text: it has the byte 0x7f here");
    says(std::string_view{"a = 1\n\0", 7}, "this is no text: it has the byte 0x00 here");
    says("a = \"\x1b[2J\"\n", "this is no text: it has the byte 0x1b here");
    says("name = \"caf\xe9\"\n", "this is no text in UTF-8: save it in that encoding");
    EXPECT_EQ(refusal("a\t=\t1\r\n"), "read");
}

/// "LINE:COLUMN: what is wrong".
std::string placed_refusal(std::string_view text)
{
    const auto document = parse_document(text);
    if (document) return "read";
    const DocumentError& error = document.error();
    return fmt::format("{}:{}: {}", error.place.line, error.place.column, error.message);
}

TEST(Document, AsksForTheQuotesOfAValueThatLacksThem)
{
    const std::string why = "a value with a unit or a name needs quotes: write ";
    EXPECT_EQ(placed_refusal("[both]\ndelay = 40ms\n"), "2:9: " + why + R"(delay = "40ms")");
    EXPECT_EQ(placed_refusal("loss = 5%"), "1:8: " + why + R"(loss = "5%")");
    EXPECT_EQ(placed_refusal("rate = 10Mbit/s # slow"), "1:8: " + why + R"(rate = "10Mbit/s")");
    EXPECT_EQ(placed_refusal("up.delay = 40 ms\r\n"), "1:12: " + why + R"(up.delay = "40ms")");
    EXPECT_EQ(placed_refusal("order = keep"), "1:9: " + why + R"(order = "keep")");
    EXPECT_EQ(placed_refusal(R"(loss = { law = gilbert, share = "2%" })"),
              "1:16: " + why + R"(law = "gilbert")");
    EXPECT_EQ(placed_refusal(R"(jitter = { law = "normal", sd = 3ms })"),
              "1:33: " + why + R"(sd = "3ms")");
    EXPECT_EQ(placed_refusal(R"(loss = ["1%", 5%])"), "1:15: " + why + R"("5%")");
    EXPECT_EQ(placed_refusal(R"(loss = [{ law = "burst" }, 5%])"), "1:28: " + why + R"("5%")");
    EXPECT_EQ(placed_refusal(R"(windows = [["10s", 12s]])"), "1:20: " + why + R"("12s")");
}

TEST(Document, NamesAQuoteThatIsMissing)
{
    const std::string why = "this text has no closing quote";
    EXPECT_EQ(placed_refusal("[both]\ndelay = \"40ms\nloss = \"1%\"\n"), "2:9: " + why);
    EXPECT_EQ(placed_refusal("delay = \"40ms"), "1:9: " + why);
    EXPECT_EQ(placed_refusal("delay = '40ms"), "1:9: " + why);
    EXPECT_EQ(placed_refusal("a = \"1\", b = \"2"), "1:14: " + why);
}

TEST(Document, NamesAKeyThatIsGivenTwice)
{
    EXPECT_EQ(placed_refusal("[both]\ndelay = \"1ms\"\nloss = \"1%\"\ndelay = \"2ms\"\n"),
              "4:1: 'delay' is given twice: give it once");
    EXPECT_EQ(placed_refusal("[up]\n[up]\n"), "2:2: 'up' is given twice: give it once");
    EXPECT_EQ(placed_refusal(R"(a = { law = "x", law = "y" })"),
              "1:18: 'law' is given twice: give it once");
}

TEST(Document, LeavesOtherMistakesToTheParserOfToml)
{
    for (const std::string_view text : {"[both\n", "delay =\n", "a = { b: 1 }\n", "a = 1 2\n",
                                        "a = [1, 2\n", "= 5\n", "a = \"b\" c\n"}) {
        EXPECT_EQ(refusal(text).find("looks like"), std::string::npos) << refusal(text);
        EXPECT_EQ(refusal(text).find("quote"), std::string::npos) << refusal(text);
        EXPECT_NE(refusal(text), "read") << text;
    }
    EXPECT_EQ(refusal("[both]\ndelay = \"80ms\"\n"), "read");
}

} // namespace
} // namespace hapnet::base
