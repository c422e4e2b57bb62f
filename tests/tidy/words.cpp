// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/tidy/words.hpp"

#include "tests/tidy/markdown.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>

namespace hapnet::tidy {

namespace {

constexpr std::size_t sentence_words_max = 35;
constexpr std::size_t slack_max = 10;

/// A line with code in backquotes as the word "code", and links as their texts.
std::string readable(std::string_view line)
{
    std::string text;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const auto code_end = line[i] == '`' ? line.find('`', i + 1) : std::string_view::npos;
        if (code_end != std::string_view::npos) {
            text += "code";
            i = code_end;
        } else if (line.substr(i, 2) == "](") {
            i = std::min(line.find(')', i), line.size() - 1);
        } else if (line[i] != '[' && line[i] != ']') {
            text += line[i];
        }
    }
    return text;
}

void add_words(Passage& passage, std::string_view line, std::size_t index)
{
    std::istringstream words{readable(line)};
    for (std::string word; words >> word;) passage.words.push_back({word, index});
}

/// The passages of a file while its lines are read.
class Reader {
public:
    void end_passage()
    {
        if (!passage_.words.empty()) passages_.push_back(std::move(passage_));
        passage_ = {};
    }

    void add(std::string_view line, std::size_t index) { add_words(passage_, line, index); }

    void add_heading(std::string_view line, std::size_t index)
    {
        end_passage();
        passage_.is_heading = true;
        add(line, index);
        end_passage();
    }

    void add_row(std::string_view row, std::size_t index)
    {
        std::string cell;
        bool is_code = false;
        for (std::size_t i = 0; i < row.size(); ++i) {
            if (row[i] == '`') is_code = !is_code;
            const bool ends = row[i] == '|' && !is_code && (i == 0 || row[i - 1] != '\\');
            if (!ends) cell += row[i];
            if (!ends && i + 1 < row.size()) continue;
            end_passage();
            if (cell.find_first_not_of(" -:|") != std::string::npos) add(cell, index);
            cell.clear();
        }
        end_passage();
    }

    std::vector<Passage> take()
    {
        end_passage();
        return std::move(passages_);
    }

private:
    std::vector<Passage> passages_;
    Passage passage_;
};

/// The length of the mark that begins an item of a list ("- ", "12. "), or 0.
std::size_t mark_of(std::string_view line)
{
    if (line.starts_with("- ") || line.starts_with("* ")) return 2;
    const auto digits = line.find_first_not_of("0123456789");
    const bool is_numbered =
        digits != 0 && digits != std::string_view::npos && line.substr(digits, 2) == ". ";
    return is_numbered ? digits + 2 : 0;
}

std::vector<Passage> passages_of_page(const SourceFile& page)
{
    Reader reader;
    const auto lines = prose_of(page);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        std::string_view line{lines[i]};
        line.remove_prefix(std::min(line.find_first_not_of(" >"), line.size()));
        if (line.empty() || line.starts_with("<!--")) {
            reader.end_passage();
        } else if (line.front() == '#') {
            reader.add_heading(line.substr(std::min(line.find(' '), line.size())), i);
        } else if (line.front() == '|') {
            reader.add_row(line, i);
        } else {
            const std::size_t mark = mark_of(line);
            if (mark > 0) reader.end_passage();
            reader.add(line.substr(mark), i);
        }
    }
    return reader.take();
}

std::vector<Passage> passages_of_header(const SourceFile& header)
{
    Reader reader;
    for (std::size_t i = 0; i < header.lines.size(); ++i) {
        const std::string_view line{header.lines[i]};
        const auto first = line.find_first_not_of(' ');
        if (first != std::string_view::npos && line.substr(first).starts_with("///")) {
            reader.add(line.substr(first + 3), i);
        } else {
            reader.end_passage();
        }
    }
    return reader.take();
}

bool is_letter_or_digit(char c)
{
    const auto byte = static_cast<unsigned char>(c);
    return byte >= 0x80 || std::isalnum(byte) != 0;
}

/// A word in lower case, without what stands before its first and after its last letter or digit.
std::string core_of(const std::string& word)
{
    const auto first = std::find_if(word.begin(), word.end(), is_letter_or_digit);
    const auto last = std::find_if(word.rbegin(), word.rend(), is_letter_or_digit).base();
    if (first >= last) return {};
    std::string core{first, last};
    std::transform(core.begin(), core.end(), core.begin(), [](unsigned char c) {
        return static_cast<char>(c < 0x80 ? std::tolower(c) : c);
    });
    return core;
}

bool ends_phrase(const std::string& word)
{
    return word.find_last_of(".,;:!?)") != std::string::npos && !is_letter_or_digit(word.back());
}

bool ends_sentence(const std::string& word)
{
    constexpr std::array abbreviations{"fig.", "figs.", "e.g.", "i.e.", "vs.", "cf.", "al."};
    const auto last = word.find_last_not_of(")\"'*_");
    if (last == std::string::npos) return false;
    if (word[last] != '.' && word[last] != '!' && word[last] != '?') return false;
    const std::string core = core_of(word) + '.';
    return std::find(abbreviations.begin(), abbreviations.end(), core) == abbreviations.end();
}

/// Some words of a passage, without the others.
using Sentence = std::vector<Word>;

std::vector<Sentence> sentences_of(const Passage& passage)
{
    std::vector<Sentence> sentences(1);
    for (const Word& word : passage.words) {
        sentences.back().push_back(word);
        if (ends_sentence(word.text)) sentences.emplace_back();
    }
    if (sentences.back().empty()) sentences.pop_back();
    return sentences;
}

std::string beginning_of(const Sentence& sentence)
{
    constexpr std::size_t words_shown = 6;
    std::string text;
    for (std::size_t i = 0; i < std::min(words_shown, sentence.size()); ++i) {
        text += (i == 0 ? "" : " ") + sentence[i].text;
    }
    return '"' + text + '"';
}

} // namespace

std::vector<Passage> passages_of(const SourceFile& file)
{
    if (file.is_page()) return passages_of_page(file);
    if (file.is_header()) return passages_of_header(file);
    return {};
}

std::vector<std::string> fragments(const SourceFile& file)
{
    constexpr std::array beginnings{"of", "whom", "what", "whether"};
    std::vector<std::string> complaints;
    for (const Passage& passage : passages_of(file)) {
        if (passage.is_heading) continue;
        const Sentence sentence = sentences_of(passage).front();
        const std::string first = core_of(sentence.front().text);
        const bool is_the_same =
            first == "the" && sentence.size() > 1 && core_of(sentence[1].text) == "same";
        const bool is_question = sentence.back().text.find('?') != std::string::npos;
        const bool begins =
            std::find(beginnings.begin(), beginnings.end(), first) != beginnings.end();
        if (is_question || (!begins && !is_the_same)) continue;
        complaints.push_back(at(sentence.front().line,
                                beginning_of(sentence) + ": begin with the noun or the verb"));
    }
    return complaints;
}

std::vector<std::string> archaic_words(const SourceFile& file)
{
    constexpr std::array anywhere{"anew", "whom", "thereby", "nobody"};
    constexpr std::array at_an_end{"likewise", "alike"};
    std::vector<std::string> complaints;
    for (const Passage& passage : passages_of(file)) {
        for (const Word& word : passage.words) {
            const std::string core = core_of(word.text);
            const bool is_last = &word == &passage.words.back() || ends_phrase(word.text);
            const bool is_found =
                std::find(anywhere.begin(), anywhere.end(), core) != anywhere.end() ||
                (is_last && std::find(at_an_end.begin(), at_an_end.end(), core) != at_an_end.end());
            if (is_found) complaints.push_back(at(word.line, core + ": use an ordinary word"));
        }
    }
    return complaints;
}

std::vector<std::string> long_sentences(const SourceFile& file)
{
    std::vector<std::string> complaints;
    if (!file.is_page()) return complaints;
    for (const Passage& passage : passages_of(file)) {
        for (const Sentence& sentence : sentences_of(passage)) {
            const auto words =
                std::count_if(sentence.begin(), sentence.end(),
                              [](const Word& word) { return !core_of(word.text).empty(); });
            if (static_cast<std::size_t>(words) <= sentence_words_max) continue;
            complaints.push_back(
                at(sentence.front().line,
                   beginning_of(sentence) + ": " + std::to_string(words) + " words in a sentence"));
        }
    }
    return complaints;
}

std::string count_key(std::string_view rule, const SourceFile& file)
{
    const auto first = file.path.find('/');
    const auto second = first == std::string::npos ? first : file.path.find('/', first + 1);
    const auto end = second == std::string::npos ? first : second;
    const std::string folder = end == std::string::npos ? "." : file.path.substr(0, end);
    return std::string{rule} + ' ' + folder;
}

Counts limits_of(const SourceFile& table)
{
    Counts limits;
    for (const std::string& line : table.lines) {
        if (line.empty() || line.front() == '#') continue;
        std::istringstream words{line};
        std::string rule, folder;
        std::size_t limit = 0;
        words >> rule >> folder >> limit;
        limits[rule + ' ' + folder] = limit;
    }
    return limits;
}

std::vector<std::string> beyond_limits(const Counts& counts, const Counts& limits)
{
    const auto value_of = [](const Counts& values, const std::string& key) {
        const auto found = values.find(key);
        return found == values.end() ? 0 : found->second;
    };
    std::vector<std::string> complaints;
    for (const auto& [key, count] : counts) {
        const std::size_t limit = value_of(limits, key);
        if (count <= limit) continue;
        complaints.push_back(key + ": " + std::to_string(count) + ", and its limit is " +
                             std::to_string(limit) + ": mend what is new");
    }
    for (const auto& [key, limit] : limits) {
        const std::size_t count = value_of(counts, key);
        if (limit <= count + slack_max) continue;
        complaints.push_back(key + ": " + std::to_string(count) + ", and its limit is still " +
                             std::to_string(limit) + ": lower the limit");
    }
    return complaints;
}

Counts lowered(const Counts& limits, const Counts& counts)
{
    Counts lower;
    for (const auto& [key, limit] : limits) {
        const auto count = counts.find(key);
        if (count == counts.end() || count->second == 0) continue;
        lower[key] = std::min(limit, count->second);
    }
    return lower;
}

} // namespace hapnet::tidy
