// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/tidy/markdown.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace hapnet::tidy {

namespace {

constexpr std::string_view glossary = "docs/GLOSSARY.md";

bool is_fence(std::string_view line)
{
    const auto first = line.find_first_not_of(' ');
    return first != std::string_view::npos && line.substr(first).starts_with("```");
}

/// GitHub's: lower case, blanks to hyphens, no other punctuation. Bytes of UTF-8 stay.
std::string slug_of(std::string_view heading)
{
    std::string slug;
    for (const char c : heading) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte >= 0x80 || std::isalnum(byte) != 0 || c == '_' || c == '-') {
            slug += static_cast<char>(byte < 0x80 ? std::tolower(byte) : byte);
        } else if (c == ' ') {
            slug += '-';
        }
    }
    return slug;
}

/// The targets of a line's inline links and pictures.
std::vector<std::string> targets_of(std::string_view line)
{
    std::vector<std::string> targets;
    for (auto begin = line.find("]("); begin != std::string_view::npos;
         begin = line.find("](", begin + 2)) {
        const auto end = line.find(')', begin);
        if (end == std::string_view::npos) break;
        targets.emplace_back(line.substr(begin + 2, end - begin - 2));
    }
    return targets;
}

/// The texts in backquotes of a line.
std::vector<std::string> code_of(std::string_view line)
{
    std::vector<std::string> code;
    for (auto begin = line.find('`'); begin != std::string_view::npos;) {
        const auto end = line.find('`', begin + 1);
        if (end == std::string_view::npos) break;
        code.emplace_back(line.substr(begin + 1, end - begin - 1));
        begin = line.find('`', end + 1);
    }
    return code;
}

bool is_path(std::string_view name)
{
    return std::all_of(name.begin(), name.end(), [](char c) {
        return is_word_character(c) || c == '/' || c == '.' || c == '-';
    });
}

/// The target of a page's link, from the root.
std::string resolved(std::string_view page, std::string_view path)
{
    const auto folder = std::filesystem::path{page}.parent_path();
    auto whole = (folder / path).lexically_normal().generic_string();
    if (whole.ends_with('/')) whole.pop_back();
    return whole;
}

bool exists(const std::set<std::string>& paths, const std::string& path)
{
    if (paths.contains(path)) return true;
    const auto inside = paths.lower_bound(path + "/"); // a folder
    return inside != paths.end() && inside->starts_with(path + "/");
}

std::size_t find_word(std::string_view line, std::string_view word)
{
    for (auto found = line.find(word); found != std::string_view::npos;
         found = line.find(word, found + 1)) {
        const auto end = found + word.size();
        const bool begins =
            found == 0 || !is_word_character(word.front()) || !is_word_character(line[found - 1]);
        const bool ends =
            end == line.size() || !is_word_character(word.back()) || !is_word_character(line[end]);
        if (begins && ends) return found;
    }
    return std::string_view::npos;
}

} // namespace

std::vector<std::string> prose_of(const SourceFile& page)
{
    std::vector<std::string> lines = page.lines;
    bool is_code = false;
    for (std::string& line : lines) {
        const bool toggles = is_fence(line);
        if (toggles) is_code = !is_code;
        if (is_code || toggles) line.clear();
    }
    return lines;
}

std::set<std::string> anchors_of(const SourceFile& page)
{
    std::set<std::string> anchors;
    for (const std::string& line : prose_of(page)) {
        const auto level = line.find_first_not_of('#');
        if (level == 0 || level == std::string::npos || level > 6 || line[level] != ' ') continue;
        const std::string slug = slug_of(std::string_view{line}.substr(level + 1));
        std::string anchor = slug;
        for (int n = 1; !anchors.insert(anchor).second; ++n) {
            anchor = slug + "-" + std::to_string(n);
        }
    }
    return anchors;
}

std::vector<std::string> dead_links(const SourceFile& page, const std::vector<SourceFile>& tree,
                                    const std::set<std::string>& paths)
{
    std::vector<std::string> complaints;
    const auto lines = prose_of(page);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        for (const std::string& target : targets_of(lines[i])) {
            if (target.find("://") != std::string::npos || target.starts_with("mailto:")) continue;
            const auto hash = target.find('#');
            const std::string path =
                hash == 0 ? page.path : resolved(page.path, target.substr(0, hash));
            if (!exists(paths, path)) {
                complaints.push_back(at(i, target + ": no such file"));
                continue;
            }
            if (hash == std::string::npos) continue;
            const auto other = std::find_if(tree.begin(), tree.end(), [&](const SourceFile& file) {
                return file.path == path;
            });
            if (other == tree.end() || !anchors_of(*other).contains(target.substr(hash + 1))) {
                complaints.push_back(at(i, target + ": no such heading"));
            }
        }
    }
    return complaints;
}

std::vector<std::string> dead_page_names(const SourceFile& file, const std::set<std::string>& paths)
{
    constexpr std::string_view folder = "docs/";
    constexpr std::string_view ending = ".md";
    std::vector<std::string> complaints;
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
        const std::string& line = file.lines[i];
        for (auto begin = line.find(folder); begin != std::string::npos;
             begin = line.find(folder, begin + 1)) {
            if (begin > 0 && (is_word_character(line[begin - 1]) || line[begin - 1] == '/'))
                continue;
            auto end = begin;
            while (end < line.size() && (is_word_character(line[end]) || line[end] == '/' ||
                                         line[end] == '-' || line[end] == '.')) {
                ++end;
            }
            auto name = line.substr(begin, end - begin);
            while (name.ends_with('.')) name.pop_back();
            if (!name.ends_with(ending) || paths.contains(name)) continue;
            complaints.push_back(at(i, name + ": no such page"));
        }
    }
    return complaints;
}

std::vector<std::string> dead_file_names(const SourceFile& page, const std::set<std::string>& paths)
{
    std::vector<std::string> complaints;
    const auto lines = prose_of(page);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        for (const std::string& name : code_of(lines[i])) {
            const auto slash = name.find('/');
            const bool is_ours =
                slash != std::string::npos && is_path(name) && exists(paths, name.substr(0, slash));
            const bool is_folder = name.ends_with('/');
            if (!is_ours || (!is_folder && name.find('.', slash) == std::string::npos)) continue;
            const std::string path = is_folder ? name.substr(0, name.size() - 1) : name;
            if (!exists(paths, path)) complaints.push_back(at(i, name + ": no such file"));
        }
    }
    return complaints;
}

std::vector<std::string> commands_not_run(const SourceFile& page, const SourceFile& cmake)
{
    bool is_left_out = false;
    bool has_commands = false;
    for (const std::string& line : page.lines) {
        if (line.starts_with("<!-- not run by readme_test: ")) is_left_out = true;
        if (line == "```sh" && !is_left_out) has_commands = true;
        if (line.starts_with("```")) is_left_out = false;
    }
    if (!has_commands) return {};
    const std::string name = page.path.substr(0, page.path.rfind('.'));
    const bool is_named =
        std::any_of(cmake.lines.begin(), cmake.lines.end(),
                    [&](const std::string& line) { return find_word(line, name) != line.npos; });
    if (is_named) return {};
    return {"its commands are run by no test: name it in tests/e2e/CMakeLists.txt, or say above a "
            "block why it is not run"};
}

std::vector<std::string> words_below(const SourceFile& page, std::string_view heading)
{
    std::vector<std::string> words;
    bool is_below = false;
    for (const std::string& line : page.lines) {
        if (line.starts_with("#")) is_below = line.ends_with(heading);
        if (!is_below || !line.starts_with("| `")) continue;
        const auto end = line.find('`', 3);
        if (end != std::string::npos) words.push_back(line.substr(3, end - 3));
    }
    return words;
}

SourceFile literals_of(const SourceFile& file)
{
    SourceFile literals = file;
    for (std::string& line : literals.lines) {
        std::string inside;
        bool is_inside = false;
        for (std::size_t i = 0; i < line.size(); ++i) {
            if (is_inside && line[i] == '\\') {
                ++i; // what is escaped ends nothing
            } else if (line[i] == '"' && (i == 0 || line[i - 1] != '\'')) {
                is_inside = !is_inside;
                inside += ' ';
            } else if (is_inside) {
                inside += line[i];
            } else if (line.compare(i, 2, "//") == 0) {
                break;
            }
        }
        line = inside;
    }
    return literals;
}

std::vector<std::string> words_in(const SourceFile& file, const std::vector<std::string>& words)
{
    std::vector<std::string> complaints;
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
        for (const std::string& word : words) {
            if (find_word(file.lines[i], word) == std::string::npos) continue;
            complaints.push_back(
                at(i, word + ": see \"" + std::string{glossary} + "\" for the word to use"));
        }
    }
    return complaints;
}

} // namespace hapnet::tidy
