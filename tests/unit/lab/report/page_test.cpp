// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/page.hpp"

#include "lab/report/base64.hpp"
#include "proto/plot/page.hpp"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::lab::report {
namespace {

/// The length of the regular expression that begins there; 0: it is a division, or none.
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

/// What is open at the end of a script or a style sheet: brackets, a text, a comment. Knows the
/// comments and texts of both, and expressions; templates are texts without templates in their ${}.
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

TEST(Page, ScriptsAndStyleSheetsAreBalanced)
{
    std::size_t scripts = 0;
    for (const Asset& asset : page_assets()) {
        if (asset.bytes.empty()) continue; // a library's
        ++scripts;
        EXPECT_EQ(left_open(asset.bytes), "") << asset.name;
        EXPECT_EQ(asset.bytes.find("</"), std::string_view::npos) << asset.name; // ends its element
    }
    EXPECT_GT(scripts, 20U);
    EXPECT_EQ(left_open(plot::style_sheet()), "");
    EXPECT_EQ(left_open(page_style()), "");
    EXPECT_GT(page_style().size(), 1000U);
    EXPECT_GT(loader_script().size(), 1000U);
}

/// What the element of the modules holds.
nlohmann::json modules_of(const PageParts& parts)
{
    const std::string element = page_modules(parts);
    const auto begin = element.find('>') + 1;
    return nlohmann::json::parse(element.substr(begin, element.rfind("</script>") - begin));
}

TEST(PageModules, AreThoseOfWhatThePageShows)
{
    EXPECT_EQ(page_modules({}), "");
    const nlohmann::json figures = modules_of({.has_figures = true, .has_player = false});
    const nlohmann::json player = modules_of({.has_figures = true, .has_player = true});
    for (const char* name : {"report/report.js", "charts.js", "strips.js", "paint/flat.js"})
        EXPECT_TRUE(figures["plain"].contains(name)) << name;
    EXPECT_FALSE(figures["plain"].contains("report/loader.js")) << "that is the page's script";
    EXPECT_FALSE(figures["packed"].contains("three.module.min.js"));
    const auto all = page_assets();
    const bool has_libraries = std::ranges::any_of(
        all, [](const Asset& asset) { return asset.name == "three.module.min.js"; });
    EXPECT_EQ(player["packed"].contains("three.module.min.js"), has_libraries);
    EXPECT_EQ(player["packed"].contains("three-LICENSE.txt"), has_libraries);
}

/// The relative names that a module imports, without and with braces.
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

/// "../dom.js" seen from "report/plot.js": "dom.js".
std::string resolved(std::string_view name, std::string_view from)
{
    return (std::filesystem::path{from}.parent_path() / name).lexically_normal().generic_string();
}

TEST(PageModules, ImportNothingThatThePageDoesNotCarry)
{
    const nlohmann::json modules = modules_of({.has_figures = true, .has_player = true});
    std::size_t count = 0;
    for (const auto& [from, source] : modules["plain"].items()) {
        for (const std::string& name : imports_of(source.get<std::string>())) {
            ++count;
            const std::string wanted = resolved(name, from);
            const bool is_library = wanted.find(".min.") != std::string::npos;
            EXPECT_TRUE(is_library || modules["plain"].contains(wanted)) << from << ": " << name;
        }
    }
    EXPECT_GT(count, 30U);
}

TEST(Base64, IsThatOfTheStandard)
{
    // RFC 4648, section 10
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foo"), "Zm9v");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64("\xff\xfe"), "//4=");
}

} // namespace
} // namespace hapnet::lab::report
