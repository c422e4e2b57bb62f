// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/tidy/arrows.hpp"
#include "tests/tidy/markdown.hpp"
#include "tests/tidy/rules.hpp"
#include "tests/tidy/source_tree.hpp"
#include "tests/tidy/words.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <utility>

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

/// True for files that may name retired words.
bool is_history(const SourceFile& file)
{
    return file.path == "docs/GLOSSARY.md" || file.path == "CHANGELOG.md" || file.is_in("docs/adr");
}

TEST(Pages, HaveNoDeadLink)
{
    const auto paths = paths_below(HAPNET_SOURCE_DIR);
    expect_none([&](const SourceFile& file) {
        return file.is_page() ? dead_links(file, tree(), paths) : std::vector<std::string>{};
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
        return file.is_page() && file.path != "CHANGELOG.md" ? dead_file_names(file, paths)
                                                             : std::vector<std::string>{};
    });
}

TEST(Pages, HaveNoCommandThatNoTestRuns)
{
    expect_none([](const SourceFile& file) {
        return file.is_page() ? commands_not_run(file, file_at("tests/e2e/CMakeLists.txt"))
                              : std::vector<std::string>{};
    });
}

/// The tests that a line of a page names in backquotes: `Suite.Test`.
std::vector<std::string> tests_named_in(const std::string& line)
{
    std::vector<std::string> named;
    for (std::size_t begin = line.find('`'); begin != std::string::npos;) {
        const std::size_t end = line.find('`', begin + 1);
        if (end == std::string::npos) break;
        const std::string word = line.substr(begin + 1, end - begin - 1);
        const std::size_t dot = word.find('.');
        const bool is_test = dot != std::string::npos && dot + 1 < word.size() && dot > 0 &&
                             std::isupper(static_cast<unsigned char>(word.front())) != 0 &&
                             std::isupper(static_cast<unsigned char>(word[dot + 1])) != 0;
        if (is_test) named.push_back(word);
        begin = line.find('`', end + 1);
    }
    return named;
}

bool is_a_test(const std::string& name)
{
    const std::size_t dot = name.find('.');
    const std::string words = '(' + name.substr(0, dot) + ", " + name.substr(dot + 1) + ')';
    return std::any_of(tree().begin(), tree().end(), [&](const SourceFile& file) {
        return file.is_in("tests") &&
               std::any_of(file.lines.begin(), file.lines.end(), [&](const std::string& line) {
                   return line.starts_with("TEST") && line.find(words) != std::string::npos;
               });
    });
}

/// The tests in Python that a line of a page names in backquotes, which are not there.
std::vector<std::string> missing_python_tests(const std::string& line, std::size_t& named)
{
    static const std::string all = [] {
        std::string text;
        for (const char* file : {"tests/e2e/web/web_test.py", "tests/e2e/web/attach_test.py"})
            for (const std::string& one : file_at(file).lines) text += one + '\n';
        return text;
    }();
    std::vector<std::string> missing;
    for (std::size_t begin = line.find("`test_"); begin != std::string::npos;
         begin = line.find("`test_", begin + 1)) {
        const std::string name = line.substr(begin + 1, line.find('`', begin + 1) - begin - 1);
        ++named;
        if (all.find("def " + name + "(self)") == std::string::npos) missing.push_back(name);
    }
    return missing;
}

TEST(Pages, NameATestForEveryAttack)
{
    for (const char* page : {"docs/design/security.md", "docs/use/web.md"}) {
        std::size_t attacks = 0;
        for (const std::string& line : file_at(page).lines) {
            const bool is_row = line.starts_with("| ") && !line.ends_with("| test |");
            if (!is_row) continue;
            ++attacks;
            const auto named = tests_named_in(line);
            std::size_t in_python = 0;
            EXPECT_EQ(missing_python_tests(line, in_python), std::vector<std::string>{});
            EXPECT_FALSE(named.empty() && in_python == 0) << line;
            for (const std::string& name : named) EXPECT_TRUE(is_a_test(name)) << name;
        }
        EXPECT_GE(attacks, 9U) << page;
    }
}

TEST(Words, ThatAreRetiredAreGone)
{
    const auto words = words_below(file_at("docs/GLOSSARY.md"), "Retired words");
    ASSERT_FALSE(words.empty());
    expect_none([&](const SourceFile& file) {
        const bool is_read = (file.is_cpp() && !file.is_in("tests")) || file.is_page();
        return is_read && !is_history(file) ? words_in(file, words) : std::vector<std::string>{};
    });
}

TEST(Words, OfThePagesArePlain)
{
    const auto words = words_below(file_at("docs/GLOSSARY.md"), "Phrases to avoid");
    ASSERT_FALSE(words.empty());
    expect_none([&](const SourceFile& file) {
        return file.is_page() && file.path != "docs/GLOSSARY.md" ? words_in(file, words)
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

// Rules with a limit per folder, in a table that HAPNET_WRITE_WORD_LIMITS=1 lowers to what is
// found.

constexpr std::string_view limits_path = "tests/tidy/word_limits.txt";

void write_limits(const Counts& limits)
{
    std::ofstream table{HAPNET_SOURCE_DIR "/" + std::string{limits_path}};
    for (const std::string& line : file_at(limits_path).lines) {
        if (line.starts_with('#')) table << line << '\n';
    }
    for (const auto& [key, limit] : limits) table << key << ' ' << limit << '\n';
}

TEST(Words, OfCommentsAndPagesKeepTheirLimits)
{
    const std::vector<std::pair<std::string, decltype(&fragments)>> rules{
        {"fragments", fragments},
        {"archaic_words", archaic_words},
        {"long_sentences", long_sentences}};
    Counts counts;
    std::map<std::string, std::string> complaints;
    for (const auto& [name, rule] : rules) {
        for (const SourceFile& file : tree()) {
            for (const std::string& complaint : rule(file)) {
                const std::string key = count_key(name, file);
                ++counts[key];
                complaints[key] += "\n" + file.path + ": " + complaint;
            }
        }
    }
    const Counts limits = limits_of(file_at(limits_path));
    if (std::getenv("HAPNET_WRITE_WORD_LIMITS") != nullptr) write_limits(lowered(limits, counts));
    for (const std::string& complaint : beyond_limits(counts, limits)) {
        ADD_FAILURE() << complaint << complaints[complaint.substr(0, complaint.find(": "))];
    }
}

} // namespace
} // namespace hapnet::tidy
