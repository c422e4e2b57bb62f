// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/tidy/rules.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <sstream>

namespace hapnet::tidy {

namespace {

constexpr std::size_t file_lines_max = 600;
constexpr std::size_t line_characters_max = 100;
constexpr std::size_t function_lines_max = 60;

bool is_code(const SourceFile& file)
{
    return file.is_cpp() || file.is_cmake() || file.is_script() || file.is_web() ||
           file.is_python();
}

/// The characters of UTF-8 text: its bytes without the continuation bytes.
std::size_t characters(std::string_view text)
{
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U;
    }));
}

/// True if the line contains the word, but not as the end of a longer word.
bool holds(std::string_view line, std::string_view word)
{
    for (auto at = line.find(word); at != std::string_view::npos; at = line.find(word, at + 1)) {
        const bool is_tail =
            at > 0 && is_word_character(word.front()) && is_word_character(line[at - 1]);
        if (!is_tail) return true;
    }
    return false;
}

struct Ban {
    std::string_view word;
    std::string_view reason;
    std::vector<std::string_view> allowed_in;
};

// Written in halves, so that this file keeps its own rules.
const std::vector<Ban>& bans()
{
    static const std::vector<Ban> list{
        {"ra"
         "nd(",
         "chance comes from base::Seed",
         {}},
        {"::no"
         "w(",
         "time is an argument",
         {"proto/net", "tests/bench", "tests/e2e", "tests/compile_fail"}},
        {"sleep_"
         "for",
         "nothing sleeps but end-to-end tests",
         {"tests/e2e"}},
        {"random_"
         "device",
         "chance comes from base::Seed",
         {}},
        {"TO"
         "DO",
         "write the issue instead",
         {}},
        {"FIX"
         "ME",
         "write the issue instead",
         {}},
        {"/wo"
         "rk/",
         "a path of somebody's workplace",
         {}},
        {"../sha"
         "red",
         "a path of somebody's workplace",
         {}},
    };
    return list;
}

/// A path with the name of one folder in place of a variable: "bench/${subject}/x.cpp".
bool is_like(std::string_view path, std::string_view pattern)
{
    const auto begin = pattern.find("${");
    const auto end = pattern.find('}');
    if (begin == std::string_view::npos || end == std::string_view::npos) return path == pattern;
    const auto before = pattern.substr(0, begin);
    const auto after = pattern.substr(end + 1);
    if (path.size() <= before.size() + after.size()) return false;
    const auto between = path.substr(before.size(), path.size() - before.size() - after.size());
    return path.starts_with(before) && path.ends_with(after) &&
           between.find('/') == std::string_view::npos;
}

/// Adds the path of each "x.cpp" that a CMakeLists.txt names, which is relative to its folder.
void add_sources_named_in(const SourceFile& cmake, std::set<std::string>& paths)
{
    const std::string folder = cmake.path.substr(0, cmake.path.rfind('/') + 1);
    for (std::string line : cmake.lines) {
        std::replace_if(
            line.begin(), line.end(), [](char c) { return c == '(' || c == ')'; }, ' ');
        std::istringstream words{line};
        bool is_folder = false;
        for (std::string word; words >> word;) {
            if (word == "FOLDERS") is_folder = true;
            if (word.ends_with(".cpp")) paths.insert(folder + word);
            if (is_folder && std::islower(static_cast<unsigned char>(word.front())) != 0) {
                paths.insert(folder + word + "/");
            }
            if (is_folder && word == ".") paths.insert(folder);
        }
    }
}

/// True if the file is in one of the folders that a CMakeLists.txt names.
bool is_in_folder_of(const std::set<std::string>& paths, std::string_view path)
{
    for (auto end = path.rfind('/'); end != std::string_view::npos;) {
        if (paths.contains(std::string{path.substr(0, end + 1)})) return true;
        end = end == 0 ? std::string_view::npos : path.rfind('/', end - 1);
    }
    return false;
}

bool is_globbed_test(const SourceFile& file)
{
    return file.is_in("tests/unit") || file.is_in("tests/property") || file.is_in("tests/sim") ||
           file.is_in("tests/conformance") || file.is_in("tests/e2e") || file.is_in("tests/fuzz") ||
           file.is_in("tests/compile_fail");
}

} // namespace

std::vector<std::string> lengths(const SourceFile& file)
{
    std::vector<std::string> complaints;
    if (!is_code(file)) return complaints;
    if (file.lines.size() > file_lines_max) {
        complaints.push_back(std::to_string(file.lines.size()) + " lines: a file is one idea");
    }
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
        const auto length = characters(file.lines[i]);
        if (length > line_characters_max) {
            complaints.push_back(at(i, std::to_string(length) + " characters"));
        }
    }
    return complaints;
}

std::vector<std::string> long_functions(const SourceFile& file)
{
    std::vector<std::string> complaints;
    if (!file.is_cpp()) return complaints;
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
        const std::string& line = file.lines[i];
        const auto indent = line.find_first_not_of(' ');
        if (indent == std::string::npos || line.substr(indent) != "{") continue;
        const std::string close = std::string(indent, ' ') + "}";
        const auto ends = [&](std::size_t at) { // "} -> T;" ends a requirement of a concept
            const std::string& end = file.lines[at];
            const auto first = end.find("} -> ");
            return end.starts_with(close) ||
                   (first != std::string::npos && first == end.find_first_not_of(' '));
        };
        for (std::size_t end = i; end < file.lines.size() && !ends(end); ++end) {
            if (end - i + 2 <= function_lines_max) continue;
            complaints.push_back(at(i, "a function of more than 60 lines"));
            break;
        }
    }
    return complaints;
}

std::vector<std::string> banned_words(const SourceFile& file)
{
    std::vector<std::string> complaints;
    for (const Ban& ban : bans()) {
        const bool is_allowed =
            std::any_of(ban.allowed_in.begin(), ban.allowed_in.end(),
                        [&](std::string_view folder) { return file.is_in(folder); });
        if (is_allowed) continue;
        for (std::size_t i = 0; i < file.lines.size(); ++i) {
            if (!holds(file.lines[i], ban.word)) continue;
            complaints.push_back(at(i, std::string{ban.word}.append(": ").append(ban.reason)));
        }
    }
    return complaints;
}

std::vector<std::string> missing_licence(const SourceFile& file)
{
    if (!is_code(file)) return {};
    const std::size_t first = file.is_script() ? 1 : 0;
    const bool is_there =
        file.lines.size() > first + 1 &&
        file.lines[first].ends_with(" SPDX-FileCopyrightText: 2026 The Hapnet authors") &&
        file.lines[first + 1].ends_with(" SPDX-License-Identifier: MIT");
    if (is_there) return {};
    return {"the two SPDX lines do not stand first"};
}

std::vector<std::string> dead_files(const std::vector<SourceFile>& tree)
{
    std::set<std::string> alive;
    for (const SourceFile& file : tree) {
        for (const Include& include : includes_of(file)) alive.insert(include.path);
        if (file.is_cmake()) add_sources_named_in(file, alive);
    }
    std::vector<std::string> complaints;
    for (const SourceFile& file : tree) {
        const bool is_ours_to_check = file.is_header() || (file.is_cpp() && !is_globbed_test(file));
        if (!is_ours_to_check || alive.contains(file.path)) continue;
        if (file.is_cpp() && !file.is_header() && is_in_folder_of(alive, file.path)) continue;
        const auto is_named = [&](const std::string& name) { return is_like(file.path, name); };
        if (std::any_of(alive.begin(), alive.end(), is_named)) continue;
        complaints.push_back(file.path + ": nothing builds or includes it");
    }
    return complaints;
}

namespace {

/// "lab/metrics/json.hpp" -> "hapnet::lab::metrics", the longest that it may have.
std::string namespace_for(const std::string& path)
{
    std::string name = "hapnet";
    for (std::size_t begin = 0, end; (end = path.find('/', begin)) != std::string::npos;
         begin = end + 1) {
        const std::string folder = path.substr(begin, end - begin);
        if (folder != "proto" && folder != "core") name += "::" + folder;
    }
    return name;
}

} // namespace

std::vector<std::string> wrong_namespaces(const SourceFile& file)
{
    if (!file.is_cpp() || file.is_in("tests")) return {};
    constexpr std::string_view opening = "namespace hapnet";
    const std::string longest = namespace_for(file.path) + "::";
    std::vector<std::string> complaints;
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
        const std::string& line = file.lines[i];
        if (!line.starts_with(opening)) continue;
        const std::string name = line.substr(10, line.find_first_of(" {", 10) - 10);
        // Namespaces nested deeper than the folder are up to the file.
        if ((name + "::").starts_with(longest) || longest.starts_with(name + "::")) continue;
        complaints.push_back(
            at(i, name + " in a folder for " + longest.substr(0, longest.size() - 2)));
    }
    return complaints;
}

std::vector<std::string> unmirrored_tests(const std::vector<SourceFile>& tree)
{
    constexpr std::string_view folder = "tests/unit/", ending = "_test.cpp";
    std::set<std::string> tested;
    for (const SourceFile& file : tree) {
        if (file.is_cpp() && !file.is_in("tests"))
            tested.insert(file.path.substr(0, file.path.rfind('.')));
    }
    std::vector<std::string> complaints;
    for (const SourceFile& file : tree) {
        if (!file.path.starts_with(folder) || !file.path.ends_with(ending)) continue;
        std::string name =
            file.path.substr(folder.size(), file.path.size() - folder.size() - ending.size());
        const std::size_t base = name.rfind('/') + 1;
        while (!tested.contains(name)) {
            const std::size_t last = name.rfind('_');
            if (last == std::string::npos || last < base) break;
            name.resize(last);
        }
        if (!tested.contains(name))
            complaints.push_back(file.path + ": called as no file it tests");
    }
    return complaints;
}

} // namespace hapnet::tidy
