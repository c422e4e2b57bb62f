// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/page/page.hpp"

#include "tests/support/page_data.hpp"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::page {
namespace {

/// The length of the regular expression that begins there; 0: a division, or no slash.
std::size_t expression_length(std::string_view source, std::size_t at)
{
    const auto before = source.find_last_not_of(' ', at == 0 ? 0 : at - 1);
    constexpr std::string_view operators = "(,=:[!&|?{};>\n";
    if (source[at] != '/' || at == 0 || operators.find(source[before]) == std::string_view::npos)
        return 0;
    bool in_class = false;
    for (std::size_t i = at + 1; i < source.size() && source[i] != '\n'; ++i) {
        if (source[i] == '\\') {
            ++i;
        } else if (source[i] == '[') {
            in_class = true;
        } else if (source[i] == ']') {
            in_class = false;
        } else if (source[i] == '/' && !in_class) {
            return i + 1 - at;
        }
    }
    return 0;
}

/// Returns the brackets, texts and comments left open by a script or style sheet. Knows regular
/// expressions. Templates count as texts, without templates in their ${}.
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
        } else if (const auto expression = expression_length(source, i); expression > 0) {
            i += expression - 1;
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
    EXPECT_EQ(left_open("f(/[(\"/]\\(/g, a / b);"), "");
}

std::string_view style_sheet()
{
    const auto all = page_assets();
    const auto found = std::ranges::find(all, "page.css", &Asset::name);
    return found == all.end() ? std::string_view{} : found->bytes;
}

TEST(Page, ScriptsAndStyleSheetsAreBalanced)
{
    std::size_t scripts = 0;
    for (const Asset& asset : page_assets()) {
        ++scripts;
        EXPECT_EQ(left_open(asset.bytes), "") << asset.name;
        EXPECT_EQ(asset.bytes.find("</"), std::string_view::npos) << asset.name; // ends its element
    }
    EXPECT_GT(scripts, 15U);
    EXPECT_GT(style_sheet().size(), 5000U);
}

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
        const bool is_of_one_element = name == "--side" || name == "--tint";
        EXPECT_TRUE(is_of_one_element || sheet.find(definition, first + 1) != std::string::npos)
            << name;
    }
}

Page sample()
{
    Page page{"session", "a <b> & c", "A lead"};
    page.head.push_back(banner("met", "fine </script>"));
    Section& section = page.sections.emplace_back(Section{"one", "First"});
    section.sources = {"a.csv"};
    section.add(paragraph("words"));
    section.add(Figure{.id = "f",
                       .title = "F",
                       .x = {"time", "s"},
                       .y = {"x", "mm"},
                       .content = Curves{{{.name = "c", .colour = "left", .points = {{0, 1}}}}}});
    page.sections.emplace_back(Section{"two", "Second"}).add(paragraph("words"));
    return page;
}

TEST(Page, CarriesItsDataInOneElementThatNothingInItCloses)
{
    const std::string html = html_of(sample());
    EXPECT_NE(html.find("<title>a &lt;b&gt; &amp; c</title>"), std::string::npos);
    EXPECT_NE(html.find("<meta name=\"hapnet-subject\" content=\"session\">"), std::string::npos);
    EXPECT_NE(html.find("name=\"viewport\""), std::string::npos);
    const auto data = test::data_of(html);
    EXPECT_EQ(data["title"], "a <b> & c");
    EXPECT_EQ(data["head"][0]["banner"], "fine </script>");
    EXPECT_EQ(data["sections"][0]["blocks"][1].dump(), R"({"figure":"f"})");
    EXPECT_EQ(data["sections"][1]["id"], "two");
    ASSERT_EQ(data["figures"].size(), 1U);
    const auto& figure = data["figures"][0];
    for (const char* key : {"id", "title", "x", "y", "series"}) EXPECT_TRUE(figure.contains(key));
    EXPECT_EQ(figure["series"][0]["name"], "c");
    EXPECT_EQ(figure["sources"][0], "a.csv");
}

TEST(Page, NeedsNoOtherFile)
{
    const std::string html = html_of(sample());
    for (const char* word : {"src=", "@import", "url(", "<link", "fetch("})
        EXPECT_EQ(html.find(word), std::string::npos) << word;
}

/// The relative names that a module imports.
std::vector<std::string> imports_of(const std::string& source)
{
    std::vector<std::string> names;
    for (const std::string_view before : {"from \"", "import(\""}) {
        for (auto at = source.find(before); at != std::string::npos; at = source.find(before, at)) {
            at += before.size();
            names.push_back(source.substr(at, source.find('"', at) - at));
        }
    }
    return names;
}

/// "../dom.js" seen from "report/document.js": "dom.js".
std::string resolved(std::string_view name, std::string_view from)
{
    return (std::filesystem::path{from}.parent_path() / name).lexically_normal().generic_string();
}

TEST(Page, ModulesImportOnlyWhatThePageCarries)
{
    const auto modules = test::json_in(html_of(sample()), "modules");
    EXPECT_TRUE(modules["plain"].contains("report/report.js"));
    EXPECT_FALSE(modules["plain"].contains("report/loader.js")) << "that is the page's script";
    EXPECT_TRUE(modules["packed"].empty());
    std::size_t count = 0;
    for (const auto& [from, source] : modules["plain"].items()) {
        for (const std::string& name : imports_of(source.get<std::string>())) {
            const std::string wanted = resolved(name, from);
            ++count;
            // Pages of results also contain the modules for the layout of results and for players.
            const bool is_of_results = wanted == "report/sections.js" ||
                                       wanted == "report/player.js" || wanted.starts_with("scene");
            EXPECT_TRUE(is_of_results || modules["plain"].contains(wanted)) << from << ": " << name;
        }
    }
    EXPECT_GT(count, 20U);
}

TEST(Page, CarriesMoreWhereItIsTold)
{
    const std::vector<Asset> more{{"player.js", "x = 1;", ""}, {"library.min.js", "", "foo"}};
    const auto modules = test::json_in(html_of(sample(), more), "modules");
    EXPECT_EQ(modules["plain"]["player.js"], "x = 1;");
    EXPECT_EQ(modules["packed"]["library.min.js"], "Zm9v");
}

} // namespace
} // namespace hapnet::page
