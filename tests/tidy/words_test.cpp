// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/tidy/words.hpp"

#include <gtest/gtest.h>

namespace hapnet::tidy {
namespace {

using Rule = std::vector<std::string> (*)(const SourceFile&);

std::size_t in_header(Rule rule, const std::string& comment)
{
    return rule(source_file("peer/x.hpp", comment)).size();
}

std::size_t in_page(Rule rule, const std::string& text)
{
    return rule(source_file("docs/x.md", text)).size();
}

std::string words(int count)
{
    std::string text = "One";
    for (int i = 1; i < count; ++i) text += " word";
    return text;
}

std::string text_of(const Passage& passage)
{
    std::string text;
    for (const Word& word : passage.words) text += (text.empty() ? "" : " ") + word.text;
    return text;
}

TEST(Passages, OfAPageAreItsHeadingsParagraphsItemsAndCells)
{
    const auto passages =
        passages_of(source_file("a.md", "# Title\nA line\nand a second\n- an item\n12. another\n\n"
                                        "| `a|b` | see [b](b.md) |\n|---|---|\n"
                                        "<!-- a comment -->\n```\ncode\n```\n"));
    std::vector<std::string> texts;
    for (const Passage& passage : passages) texts.push_back(text_of(passage));
    EXPECT_EQ(texts, (std::vector<std::string>{"Title", "A line and a second", "an item", "another",
                                               "code", "see b"}));
    EXPECT_TRUE(passages.front().is_heading);
    EXPECT_FALSE(passages[1].is_heading);
    EXPECT_EQ(passages[1].words.back().line, 2U);
}

TEST(Passages, OfAHeaderAreItsPublicComments)
{
    const std::string text = "/// One\n/// comment.\nint x; // private\n    /// Another.\nint y;\n";
    ASSERT_EQ(passages_of(source_file("peer/x.hpp", text)).size(), 2U);
    EXPECT_EQ(text_of(passages_of(source_file("peer/x.hpp", text))[0]), "One comment.");
    EXPECT_TRUE(passages_of(source_file("peer/x.cpp", text)).empty());
}

TEST(Fragments, AreCommentsThatBeginWithoutANounOrAVerb)
{
    EXPECT_EQ(in_header(fragments, "/// Of moving and turning, J.\n"), 1U);
    EXPECT_EQ(in_header(fragments, "/// Whom a peer plays with.\n"), 1U);
    EXPECT_EQ(in_header(fragments, "/// What can be saved up.\n"), 1U);
    EXPECT_EQ(in_header(fragments, "/// Whether the body sleeps.\n"), 1U);
    EXPECT_EQ(in_header(fragments, "/// The same, were it oriented so.\n"), 1U);
    EXPECT_EQ(in_header(fragments, "/// The energy.\n/// Of both bodies.\n"), 0U);
    EXPECT_EQ(in_header(fragments, "/// True if the body sleeps.\n"), 0U);
    EXPECT_EQ(in_header(fragments, "/// Offset of the clock, s.\n"), 0U);
    EXPECT_EQ(in_header(fragments, "// Of no public name.\n"), 0U);
}

TEST(Fragments, OfAPageAreFoundInCellsAndItemsAndAreNoQuestions)
{
    EXPECT_EQ(in_page(fragments, "| `valid` | whether the run is valid |\n"), 1U);
    EXPECT_EQ(in_page(fragments, "- **Of** each client.\n"), 1U);
    EXPECT_EQ(in_page(fragments, "# What you see\n"), 0U);
    EXPECT_EQ(in_page(fragments, "What is late? The datagram.\n"), 0U);
    EXPECT_EQ(in_page(fragments, "It is late.\nOf course.\n"), 0U);
}

TEST(ArchaicWords, AreFoundInCommentsAndPages)
{
    for (const char* word : {"anew", "whom", "thereby", "Nobody"}) {
        EXPECT_EQ(in_header(archaic_words, "/// It was " + std::string{word} + " there.\n"), 1U)
            << word;
        EXPECT_EQ(in_page(archaic_words, "It was (" + std::string{word} + ") there.\n"), 1U)
            << word;
    }
    EXPECT_EQ(in_page(archaic_words, "Run it as `nobody`.\n"), 0U);
    EXPECT_EQ(in_header(archaic_words, "// begins anew\n"), 0U);
}

TEST(ArchaicWords, LikewiseAndAlikeAreFoundAtTheEndOfAPhrase)
{
    EXPECT_EQ(in_page(archaic_words, "Both are read alike.\n"), 1U);
    EXPECT_EQ(in_page(archaic_words, "Both likewise, and the third\n"), 1U);
    EXPECT_EQ(in_page(archaic_words, "The second likewise\n"), 1U);
    EXPECT_EQ(in_page(archaic_words, "Keys that look alike could be found.\n"), 0U);
}

TEST(LongSentences, HaveMoreThan35WordsAndStandInAPage)
{
    EXPECT_EQ(in_page(long_sentences, words(35) + ".\n"), 0U);
    EXPECT_EQ(in_page(long_sentences, words(36) + ".\n"), 1U);
    EXPECT_EQ(in_page(long_sentences, words(20) + "\n" + words(20) + ".\n"), 1U);
    EXPECT_EQ(in_page(long_sentences, words(20) + ".\n" + words(20) + ".\n"), 0U);
    EXPECT_EQ(in_page(long_sentences, words(20) + ".) " + words(20) + ".\n"), 0U);
    EXPECT_EQ(in_page(long_sentences, words(20) + "\n\n" + words(20) + ".\n"), 0U);
    EXPECT_EQ(in_header(long_sentences, "/// " + words(36) + ".\n"), 0U);
}

TEST(LongSentences, CountCodeAsOneWordAndNoSignAsAWord)
{
    EXPECT_EQ(in_page(long_sentences, words(34) + " `a b c d`.\n"), 0U);
    EXPECT_EQ(in_page(long_sentences, words(35) + " = .\n"), 0U);
    EXPECT_EQ(in_page(long_sentences, words(34) + " [one](two three four).\n"), 0U);
    EXPECT_EQ(in_page(long_sentences, words(20) + " of Fig. " + words(20) + ".\n"), 1U);
}

TEST(WordLimits, AreKeptPerRuleAndFolder)
{
    EXPECT_EQ(count_key("fragments", source_file("scene/rigid/contact/x.hpp", "")),
              "fragments scene/rigid");
    EXPECT_EQ(count_key("fragments", source_file("ctl/x.hpp", "")), "fragments ctl");
    EXPECT_EQ(count_key("fragments", source_file("README.md", "")), "fragments .");
    EXPECT_EQ(limits_of(source_file("t", "# a comment\n\nfragments docs/use 12\n")),
              (Counts{{"fragments docs/use", 12}}));
}

TEST(WordLimits, RefuseMoreComplaintsAndLimitsThatAreTooHigh)
{
    const Counts limits{{"fragments ctl", 20}};
    EXPECT_EQ(beyond_limits({{"fragments ctl", 21}}, limits).size(), 1U);
    EXPECT_EQ(beyond_limits({{"fragments ctl", 20}}, limits).size(), 0U);
    EXPECT_EQ(beyond_limits({{"fragments ctl", 10}}, limits).size(), 0U);
    EXPECT_EQ(beyond_limits({{"fragments ctl", 9}}, limits).size(), 1U);
    EXPECT_EQ(beyond_limits({}, limits).size(), 1U);
    EXPECT_EQ(beyond_limits({{"fragments web", 1}}, {}).size(), 1U);
}

TEST(WordLimits, OnlyFall)
{
    const Counts limits{{"fragments ctl", 5}, {"fragments web", 5}, {"fragments peer", 5}};
    const Counts counts{{"fragments ctl", 3}, {"fragments web", 7}, {"fragments lab", 1}};
    EXPECT_EQ(lowered(limits, counts), (Counts{{"fragments ctl", 3}, {"fragments web", 5}}));
}

} // namespace
} // namespace hapnet::tidy
