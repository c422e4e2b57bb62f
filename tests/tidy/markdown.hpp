// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/tidy/source_tree.hpp"

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::tidy {

// Rules of the pages. Each gives its complaints, one line of text each; none when all is well.

/// The lines of a page, where lines of code blocks are empty.
[[nodiscard]] std::vector<std::string> prose_of(const SourceFile& page);

/// The anchors of a page, as GitHub makes them from its headings.
[[nodiscard]] std::set<std::string> anchors_of(const SourceFile& page);

/// Relative links and anchors of a page that lead nowhere. `paths` are all files of the project,
/// pictures too.
[[nodiscard]] std::vector<std::string> dead_links(const SourceFile& page,
                                                  const std::vector<SourceFile>& tree,
                                                  const std::set<std::string>& paths);

/// Pages that a file names from the root ("docs/..." with its ending) and that do not exist.
[[nodiscard]] std::vector<std::string> dead_page_names(const SourceFile& file,
                                                       const std::set<std::string>& paths);

/// Files and folders of the project that a page names in backquotes ("peer/main.cpp",
/// "lab/metrics/") and that do not exist.
[[nodiscard]] std::vector<std::string> dead_file_names(const SourceFile& page,
                                                       const std::set<std::string>& paths);

/// Pages with commands to run that tests/e2e/CMakeLists.txt does not name.
[[nodiscard]] std::vector<std::string> commands_not_run(const SourceFile& page,
                                                        const SourceFile& cmake);

/// The first column of the table below a heading: the texts in backquotes.
[[nodiscard]] std::vector<std::string> words_below(const SourceFile& page,
                                                   std::string_view heading);

/// A C++ file with nothing left but the insides of its string literals, line by line.
[[nodiscard]] SourceFile literals_of(const SourceFile& file);

/// Whole words or phrases of `words` in a file; case matters.
[[nodiscard]] std::vector<std::string> words_in(const SourceFile& file,
                                                const std::vector<std::string>& words);

} // namespace hapnet::tidy
