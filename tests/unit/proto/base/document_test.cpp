// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/document.hpp"

#include <gtest/gtest.h>

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

TEST(Document, LeavesOtherMistakesToTheParserOfToml)
{
    for (const std::string_view text : {"[both\n", "delay = 80ms\n", "a = { b: 1 }\n"}) {
        EXPECT_EQ(refusal(text).find("looks like"), std::string::npos) << refusal(text);
    }
    EXPECT_EQ(refusal("[both]\ndelay = \"80ms\"\n"), "read");
}

} // namespace
} // namespace hapnet::base
