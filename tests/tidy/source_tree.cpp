// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/tidy/source_tree.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace hapnet::tidy {

namespace {

namespace fs = std::filesystem;

/// Built and recorded files are at the top, as in .gitignore, and npm's are beside tests.
/// docs/results belongs to the project.
bool is_left_out(const fs::recursive_directory_iterator& folder)
{
    const auto name = folder->path().filename().string();
    const bool is_output = folder.depth() == 0 && (name == "build" || name == "results");
    return is_output || name == "node_modules" || (name.front() == '.' && name != ".ci");
}

bool is_text(const fs::path& file)
{
    constexpr std::array extensions{".hpp",  ".cpp", ".in",   ".txt", ".cmake", ".sh",
                                    ".json", ".md",  ".toml", ".css", ".js",    ".py"};
    if (file.filename() == ".git") return false; // where a worktree has its history
    const auto extension = file.extension().string();
    return extension.empty() ||
           std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

} // namespace

bool SourceFile::is_header() const { return path.ends_with(".hpp"); }

bool SourceFile::is_cpp() const { return is_header() || path.ends_with(".cpp"); }

bool SourceFile::is_cmake() const
{
    return path.ends_with("CMakeLists.txt") || path.ends_with(".cmake");
}

bool SourceFile::is_script() const { return !lines.empty() && lines.front().starts_with("#!"); }

bool SourceFile::is_python() const { return path.ends_with(".py"); }

bool SourceFile::is_page() const { return path.ends_with(".md"); }

bool SourceFile::is_web() const { return path.ends_with(".css") || path.ends_with(".js"); }

bool SourceFile::is_in(std::string_view folder) const
{
    return path.starts_with(std::string{folder} + "/");
}

std::vector<Include> includes_of(const SourceFile& file)
{
    constexpr std::string_view directive = "#include ";
    std::vector<Include> includes;
    for (const std::string& line : file.lines) {
        if (!line.starts_with(directive) || line.size() < directive.size() + 2) continue;
        const bool is_quoted = line[directive.size()] == '"';
        const auto path = std::string_view{line}.substr(directive.size() + 1);
        includes.push_back(
            {std::string{path.substr(0, path.find(is_quoted ? '"' : '>'))}, is_quoted});
    }
    return includes;
}

SourceFile source_file(std::string path, std::string_view text)
{
    SourceFile file{std::move(path), {}};
    std::istringstream stream{std::string{text}};
    for (std::string line; std::getline(stream, line);) file.lines.push_back(line);
    return file;
}

std::vector<SourceFile> read_tree(const std::string& root)
{
    std::vector<SourceFile> files;
    for (auto entry = fs::recursive_directory_iterator{root}; entry != fs::end(entry); ++entry) {
        if (entry->is_directory()) {
            if (is_left_out(entry)) entry.disable_recursion_pending();
            continue;
        }
        if (!is_text(entry->path())) continue;
        const std::ifstream stream{entry->path()};
        std::ostringstream text;
        text << stream.rdbuf();
        files.push_back(source_file(entry->path().lexically_relative(root).string(), text.str()));
    }
    std::sort(files.begin(), files.end(),
              [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
    return files;
}

std::set<std::string> paths_below(const std::string& root)
{
    std::set<std::string> paths;
    for (auto entry = fs::recursive_directory_iterator{root}; entry != fs::end(entry); ++entry) {
        if (entry->is_directory()) {
            if (is_left_out(entry)) entry.disable_recursion_pending();
            continue;
        }
        paths.insert(entry->path().lexically_relative(root).string());
    }
    return paths;
}

std::string at(std::size_t index, const std::string& what)
{
    return "line " + std::to_string(index + 1) + ": " + what;
}

bool is_word_character(char c)
{
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

} // namespace hapnet::tidy
