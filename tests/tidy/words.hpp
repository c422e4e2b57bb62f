// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/tidy/source_tree.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::tidy {

// Rules of plain English for public comments and for pages. Each rule gives its complaints, one
// line of text each; none when all is well.

/// A word with its punctuation, and its line, which is counted from 0.
struct Word {
    std::string text;
    std::size_t line = 0;
};

/// A run of words that belong together. Code in backquotes is one word, and a link only its text.
struct Passage {
    std::vector<Word> words;
    bool is_heading = false;
};

/// The public comments of a header (`///`), or the headings, paragraphs, items and table cells of a
/// page. Other files have no passages.
[[nodiscard]] std::vector<Passage> passages_of(const SourceFile& file);

/// Passages that begin with `Of`, `Whom`, `What`, `Whether` or `The same`, except headings and
/// questions.
[[nodiscard]] std::vector<std::string> fragments(const SourceFile& file);

/// The words `anew`, `whom`, `thereby` and `nobody` anywhere, and `likewise` and `alike` at the end
/// of a phrase.
[[nodiscard]] std::vector<std::string> archaic_words(const SourceFile& file);

/// Sentences of more than 35 words in a page.
[[nodiscard]] std::vector<std::string> long_sentences(const SourceFile& file);

/// Complaints per rule and folder ("fragments docs/use"). A folder has at most two levels, and the
/// root is ".".
using Counts = std::map<std::string, std::size_t>;

/// The key of a rule and a file in Counts.
[[nodiscard]] std::string count_key(std::string_view rule, const SourceFile& file);

/// Reads a table of limits: one line per rule and folder, "fragments docs/use 12". Lines that
/// begin with '#' are comments.
[[nodiscard]] Counts limits_of(const SourceFile& table);

/// Counts above their limits, where a limit that is missing is 0, and limits that are more than 10
/// above their counts. The 10 let several branches mend a few sentences without changing the table.
[[nodiscard]] std::vector<std::string> beyond_limits(const Counts& counts, const Counts& limits);

/// The limits, each lowered to its count. A limit never rises, and a limit of 0 is left out.
[[nodiscard]] Counts lowered(const Counts& limits, const Counts& counts);

} // namespace hapnet::tidy
