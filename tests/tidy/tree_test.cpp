// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/tidy/arrows.hpp"
#include "tests/tidy/markdown.hpp"
#include "tests/tidy/rules.hpp"
#include "tests/tidy/source_tree.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace hapnet::tidy {
namespace {

const std::vector<SourceFile>& tree()
{
    static const std::vector<SourceFile> files = read_tree(HAPNET_SOURCE_DIR);
    return files;
}

template <typename Rule>
void expect_none(Rule rule)
{
    for (const SourceFile& file : tree()) {
        for (const std::string& complaint : rule(file)) {
            ADD_FAILURE() << file.path << ": " << complaint;
        }
    }
}

TEST(Tree, IsReadWhole)
{
    const auto holds = [](std::string_view path) {
        return std::any_of(tree().begin(), tree().end(),
                           [&](const SourceFile& file) { return file.path == path; });
    };
    EXPECT_TRUE(holds("proto/base/time.hpp"));
    EXPECT_TRUE(holds("scripts/setup.sh"));
    EXPECT_TRUE(holds("docs/results/benchmarks.md"));
    EXPECT_TRUE(holds(".ci/run"));
    EXPECT_TRUE(holds("tests/tidy/tree_test.cpp"));
    EXPECT_FALSE(holds(".git/HEAD"));
}

TEST(Tree, IncludesFollowTheArrowsOfTheMap) { expect_none(wrong_arrows); }

TEST(Tree, CoresDoNoInputOrOutputAndReadNoClock) { expect_none(impure_includes); }

TEST(Tree, FilesAndLinesKeepTheirLengths) { expect_none(lengths); }

TEST(Tree, FunctionsKeepTheirLength) { expect_none(long_functions); }

TEST(Tree, HoldsNoBannedWord) { expect_none(banned_words); }

TEST(Tree, EveryFileNamesItsLicence) { expect_none(missing_licence); }

TEST(Tree, HasNoDeadFile)
{
    for (const std::string& complaint : dead_files(tree())) ADD_FAILURE() << complaint;
}

TEST(Tree, NamespacesAreCalledAsTheirFolders) { expect_none(wrong_namespaces); }

TEST(Tree, UnitTestsAreCalledAsTheFilesTheyTest)
{
    for (const std::string& complaint : unmirrored_tests(tree())) ADD_FAILURE() << complaint;
}

// The pages.

const SourceFile& file_at(std::string_view path)
{
    const auto found = std::find_if(tree().begin(), tree().end(),
                                    [&](const SourceFile& file) { return file.path == path; });
    EXPECT_NE(found, tree().end()) << path;
    return *found;
}

bool is_page(const SourceFile& file) { return file.path.ends_with(".md"); }

/// Where words that are not used any more are told of.
bool is_history(const SourceFile& file)
{
    return file.path == "docs/GLOSSARY.md" || file.path == "CHANGELOG.md" || file.is_in("docs/adr");
}

TEST(Pages, HaveNoDeadLink)
{
    const auto paths = paths_below(HAPNET_SOURCE_DIR);
    expect_none([&](const SourceFile& file) {
        return is_page(file) ? dead_links(file, tree(), paths) : std::vector<std::string>{};
    });
}

TEST(Pages, ThatAFileNamesExist)
{
    const auto paths = paths_below(HAPNET_SOURCE_DIR);
    expect_none([&](const SourceFile& file) {
        return file.is_in("tests/tidy") ? std::vector<std::string>{} : dead_page_names(file, paths);
    });
}

TEST(Pages, NameNoFileThatIsGone)
{
    const auto paths = paths_below(HAPNET_SOURCE_DIR);
    expect_none([&](const SourceFile& file) {
        return is_page(file) && file.path != "CHANGELOG.md" ? dead_file_names(file, paths)
                                                            : std::vector<std::string>{};
    });
}

TEST(Pages, HaveNoCommandThatNoTestRuns)
{
    expect_none([](const SourceFile& file) {
        return is_page(file) ? commands_not_run(file, file_at("tests/e2e/CMakeLists.txt"))
                             : std::vector<std::string>{};
    });
}

TEST(Words, ThatAreRetiredAreGone)
{
    const auto words = words_below(file_at("docs/GLOSSARY.md"), "Retired words");
    ASSERT_FALSE(words.empty());
    expect_none([&](const SourceFile& file) {
        const bool is_read = (file.is_cpp() && !file.is_in("tests")) || is_page(file);
        return is_read && !is_history(file) ? words_in(file, words) : std::vector<std::string>{};
    });
}

TEST(Words, OfThePagesArePlain)
{
    const auto words = words_below(file_at("docs/GLOSSARY.md"), "Phrases to avoid");
    ASSERT_FALSE(words.empty());
    expect_none([&](const SourceFile& file) {
        return is_page(file) && file.path != "docs/GLOSSARY.md" ? words_in(file, words)
                                                                : std::vector<std::string>{};
    });
}

TEST(Words, OfTheProgramsArePlain)
{
    const auto words = words_below(file_at("docs/GLOSSARY.md"), "Phrases to avoid");
    expect_none([&](const SourceFile& file) {
        const bool is_read = file.is_cpp() && !file.is_in("tests");
        return is_read ? words_in(literals_of(file), words) : std::vector<std::string>{};
    });
}

} // namespace
} // namespace hapnet::tidy
