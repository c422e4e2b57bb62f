// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::tidy {

/// One text file of the project.
struct SourceFile {
    std::string path; // from the root, with '/'
    std::vector<std::string> lines;

    [[nodiscard]] bool is_cpp() const;    // a C++ header or source
    [[nodiscard]] bool is_header() const; // a C++ header
    [[nodiscard]] bool is_cmake() const;
    [[nodiscard]] bool is_script() const; // starts with #!
    [[nodiscard]] bool is_web() const;    // a script or a style sheet of a page
    [[nodiscard]] bool is_python() const;
    [[nodiscard]] bool is_page() const; // Markdown
    /// True if the file lies in `folder` ("proto/net") or below it.
    [[nodiscard]] bool is_in(std::string_view folder) const;
};

/// The file that one #include line names.
struct Include {
    std::string path;
    bool is_quoted = false; // "ours", not <theirs>
};
[[nodiscard]] std::vector<Include> includes_of(const SourceFile& file);

/// A complaint about a line, which is counted from 0.
[[nodiscard]] std::string at(std::size_t index, const std::string& what);

/// True for the characters of a word: letters, digits and '_'.
[[nodiscard]] bool is_word_character(char c);

/// A file from its path and its text.
[[nodiscard]] SourceFile source_file(std::string path, std::string_view text);

/// Every text file below `root` that the project holds, without what is built or recorded there.
[[nodiscard]] std::vector<SourceFile> read_tree(const std::string& root);

/// The paths of all files below `root` that the project holds, text or not.
[[nodiscard]] std::set<std::string> paths_below(const std::string& root);

} // namespace hapnet::tidy
