// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/tidy/markdown.hpp"

#include <gtest/gtest.h>

namespace hapnet::tidy {
namespace {

const std::set<std::string> paths{"README.md", "docs/a.md", "docs/b.md", "docs/images/c.png"};

std::size_t dead(const std::string& text)
{
    const std::vector<SourceFile> tree{source_file("docs/b.md", "# One\n## Two words, `x`: 3\n")};
    return dead_links(source_file("docs/a.md", text), tree, paths).size();
}

TEST(Markdown, LinksLeadToFilesFoldersAndPictures)
{
    EXPECT_EQ(dead("[b](b.md), [images](images/), [up](../README.md), ![c](images/c.png)"), 0U);
    EXPECT_EQ(dead("[web](https://example.org/x.md)"), 0U);
    EXPECT_EQ(dead("[gone](gone.md)"), 1U);
    EXPECT_EQ(dead("[a](b.md) and [gone](../b.md)"), 1U);
}

TEST(Markdown, AnchorsAreThoseOfTheHeadings)
{
    EXPECT_EQ(dead("[two](b.md#two-words-x-3)"), 0U);
    EXPECT_EQ(dead("[none](b.md#two)"), 1U);
    EXPECT_EQ(anchors_of(source_file("a.md", "# One\n# One\n")),
              (std::set<std::string>{"one", "one-1"}));
}

TEST(Markdown, CodeHasNoLinks)
{
    EXPECT_EQ(dead("```\n[gone](gone.md)\n```\n"), 0U);
    EXPECT_TRUE(anchors_of(source_file("a.md", "```sh\n# a comment\n```\n")).empty());
}

TEST(Markdown, PagesNamedFromTheRootExist)
{
    const auto complaints = [](const std::string& text) {
        return dead_page_names(source_file("peer/main.cpp", text), paths).size();
    };
    EXPECT_EQ(complaints("// docs/a.md says more."), 0U);
    EXPECT_EQ(complaints("// see docs/a.md."), 0U);
    EXPECT_EQ(complaints("// see docs/gone.md and docs/a.md"), 1U);
}

TEST(Markdown, FilesAndFoldersNamedInBackquotesExist)
{
    const auto complaints = [](const std::string& text) {
        return dead_file_names(source_file("README.md", text), paths).size();
    };
    EXPECT_EQ(complaints("`docs/a.md` in `docs/images/`, drawn from `docs/ID/wander`"), 0U);
    EXPECT_EQ(complaints("`docs/gone.hpp` and `docs/gone/` and `docs/a.md`"), 2U);
    EXPECT_EQ(complaints("`up/jitter`, `a.md`, `docs/*.cpp`, docs/gone.hpp"), 0U);
}

TEST(Markdown, CommandsAreRunOrSayWhyNot)
{
    const auto cmake = source_file("tests/e2e/CMakeLists.txt", "foreach(page docs/a)\n");
    const auto complaints = [&](const char* path, const std::string& text) {
        return commands_not_run(source_file(path, text), cmake).size();
    };
    EXPECT_EQ(complaints("docs/a.md", "```sh\nls\n```\n"), 0U);
    EXPECT_EQ(complaints("docs/b.md", "```sh\nls\n```\n"), 1U);
    EXPECT_EQ(complaints("docs/b.md", "<!-- not run by readme_test: long -->\n```sh\nls\n```\n"),
              0U);
    EXPECT_EQ(complaints("docs/b.md", "```\nls\n```\n"), 0U);
}

TEST(Markdown, WordsAreTakenFromTheTableBelowTheirHeading)
{
    const auto page = source_file("docs/GLOSSARY.md", "## Retired\n\n| word | now |\n|---|---|\n"
                                                      "| `old` | `new` |\n| `two words` | one |\n"
                                                      "## Other\n| `kept` | |\n");
    EXPECT_EQ(words_below(page, "Retired"), (std::vector<std::string>{"old", "two words"}));
}

TEST(Markdown, WordsAreWhole)
{
    const auto complaints = [](const std::string& text) {
        return words_in(source_file("a.md", text), {"Seat", "so many"}).size();
    };
    EXPECT_EQ(complaints("a Seat there"), 1U);
    EXPECT_EQ(complaints("Seats, Seat_, seat"), 0U);
    EXPECT_EQ(complaints("also many; so many"), 1U);
}

TEST(Markdown, LiteralsAreWithoutTheirCodeAndComments)
{
    const auto inside = [](const std::string& line) {
        return literals_of(source_file("a.cpp", line)).lines.front();
    };
    EXPECT_EQ(inside(R"(say("one", x, "two"); // "three")"), " one  two ");
    EXPECT_EQ(inside(R"(say("a \"b\" // c");)"), " a b // c ");
    EXPECT_EQ(inside("quote = '\"'; say(\"x\");"), " x ");
}

} // namespace
} // namespace hapnet::tidy
