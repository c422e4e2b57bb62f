// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/plot/page.hpp"

#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace hapnet::plot {
namespace {

TEST(Page, EveryColourThatIsUsedIsDefinedForLightAndDark)
{
    const std::string sheet{style_sheet()};
    std::vector<std::string> names;
    for (std::size_t at = 0; (at = sheet.find("var(--", at)) != std::string::npos; ++at) {
        names.push_back(sheet.substr(at + 4, sheet.find(')', at) - at - 4));
    }
    EXPECT_FALSE(names.empty());
    for (const std::string& name : names) {
        const std::string definition = name + ": ";
        const auto first = sheet.find(definition);
        ASSERT_NE(first, std::string::npos) << name;
        EXPECT_NE(sheet.find(definition, first + 1), std::string::npos) << name;
    }
}

TEST(Page, HeadTakesTextAndFootEndsIt)
{
    const std::string head = page_head("a <b> & c", "session");
    EXPECT_NE(head.find("<title>a &lt;b&gt; &amp; c</title>"), std::string::npos);
    EXPECT_NE(head.find("name=\"viewport\""), std::string::npos);
    EXPECT_TRUE(page_foot().ends_with("</html>\n"));
    EXPECT_EQ(page_foot().find("<script>"), std::string::npos);
}

TEST(Standalone, TakesTheLightColoursOfTheStyleSheet)
{
    const std::string svg = standalone("<svg viewBox='0 0 1 1'><path fill='var(--missed)'/></svg>");
    EXPECT_NE(svg.find("fill='#c40d1e'"), std::string::npos) << svg;
    EXPECT_NE(svg.find("viewBox='0 0 1 1'"), std::string::npos);
}

} // namespace
} // namespace hapnet::plot
