// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/tidy/source_tree.hpp"

#include <string>
#include <vector>

namespace hapnet::tidy {

// Each rule takes a file and gives its complaints, one line of text each; none when all is well.

/// At most 400 lines of at most 100 characters.
[[nodiscard]] std::vector<std::string> lengths(const SourceFile& file);

/// Functions of at most 60 lines from brace to brace. A body is recognised by its braces, which
/// clang-format puts on lines of their own.
[[nodiscard]] std::vector<std::string> long_functions(const SourceFile& file);

/// Words that have no place in the project, or not in this file.
[[nodiscard]] std::vector<std::string> banned_words(const SourceFile& file);

/// The two SPDX lines at the top of code and scripts.
[[nodiscard]] std::vector<std::string> missing_licence(const SourceFile& file);

/// Sources that no CMakeLists.txt of the tree builds, and headers that no file includes.
[[nodiscard]] std::vector<std::string> dead_files(const std::vector<SourceFile>& tree);

/// Namespaces that are not called as their folder: in lab/metrics and below it hapnet::lab::metrics
/// is right. A folder may share the namespace of the one above; `proto` and `core` are in no name.
[[nodiscard]] std::vector<std::string> wrong_namespaces(const SourceFile& file);

/// Unit tests that are not called as the file they test: that of a/b/c.cpp is
/// tests/unit/a/b/c_test.cpp, and one of its aspects tests/unit/a/b/c_ASPECT_test.cpp.
[[nodiscard]] std::vector<std::string> unmirrored_tests(const std::vector<SourceFile>& tree);

} // namespace hapnet::tidy
