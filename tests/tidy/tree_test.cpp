// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/tidy/arrows.hpp"
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

} // namespace
} // namespace hapnet::tidy
