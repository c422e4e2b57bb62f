// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/page.hpp"

#include "proto/plot/page.hpp"

#include <gtest/gtest.h>
#include <string>
#include <string_view>

namespace hapnet::lab::report {
namespace {

/// What is open at the end of a script or a style sheet: brackets, a text, a comment. Knows the
/// comments and texts of both; templates are texts whose ${} hold no texts of their own.
std::string left_open(std::string_view source)
{
    std::string open;
    for (std::size_t i = 0; i < source.size(); ++i) {
        const char c = source[i];
        const auto rest = source.substr(i);
        if (rest.starts_with("//") || rest.starts_with("/*")) {
            const std::string_view end = rest[1] == '/' ? "\n" : "*/";
            const auto length = rest.find(end, 2);
            if (length == std::string_view::npos) return open + std::string{rest.substr(0, 2)};
            i += length + end.size() - 1;
        } else if (c == '"' || c == '\'' || c == '`') {
            const auto length = rest.find(c, 1);
            if (length == std::string_view::npos) return open + c;
            i += length;
        } else if (c == '(' || c == '[' || c == '{') {
            open += c;
        } else if (c == ')' || c == ']' || c == '}') {
            const char begin = c == ')' ? '(' : c == ']' ? '[' : '{';
            if (open.empty() || open.back() != begin) return open + c;
            open.pop_back();
        }
    }
    return open;
}

TEST(LeftOpen, SeesWhatIsNotClosed)
{
    EXPECT_EQ(left_open("f({a: [1, ')', \"]\"] /* ( */}); // {"), "//");
    EXPECT_EQ(left_open("f({a: [1]});\n"), "");
    EXPECT_EQ(left_open("f({a: 1)"), "({)");
    EXPECT_EQ(left_open("`a"), "`");
}

TEST(Page, ScriptsAndStyleSheetAreBalanced)
{
    for (const auto source :
         {plot::style_sheet(), figures_script(), zoom_script(), player_script()}) {
        EXPECT_GT(source.size(), 1000U);
        EXPECT_EQ(left_open(source), "");
        EXPECT_EQ(source.find("</"), std::string_view::npos); // would end its element
    }
}

} // namespace
} // namespace hapnet::lab::report
