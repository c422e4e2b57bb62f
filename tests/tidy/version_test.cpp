// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The version is that of project() in CMakeLists.txt. Files that no build writes repeat it.
#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <string>

namespace hapnet::tidy {
namespace {

std::string text_of(const std::string& path)
{
    std::ifstream file{std::string{HAPNET_SOURCE_DIR} + "/" + path};
    return '\n' + std::string{std::istreambuf_iterator<char>{file}, {}};
}

/// The text between the first `before` and the next `after`.
std::string between(const std::string& text, const std::string& before, const std::string& after)
{
    const auto found = text.find(before);
    if (found == std::string::npos) return {};
    const auto begin = found + before.size();
    return text.substr(begin, text.find(after, begin) - begin);
}

TEST(Version, IsTheSameWhereverItStands)
{
    const auto version = between(text_of("CMakeLists.txt"), "project(hapnet VERSION ", " ");
    ASSERT_EQ(std::count(version.begin(), version.end(), '.'), 2) << version;
    EXPECT_EQ(between(text_of("CITATION.cff"), "\nversion: ", "\n"), version);
    EXPECT_EQ(between(text_of("python/hapnet/__init__.py"), "__version__ = \"", "\""), version);
    EXPECT_EQ(between(text_of("docs/results/limitations.md"), "Version ", ".\n"), version);
    EXPECT_NE(text_of("CHANGELOG.md").find("\n## [" + version + "] - "), std::string::npos)
        << "the changes of this version, with their date";
}

} // namespace
} // namespace hapnet::tidy
