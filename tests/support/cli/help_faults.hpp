// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/cli/command.hpp"
#include "tests/support/cli/typed.hpp"

#include <functional>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace hapnet::cli {

/// Returns a program's output for some words; nullopt where it would run, or refuses them.
using Prints = std::function<std::optional<std::string>(std::vector<std::string> words)>;

/// The lines of a text.
inline std::vector<std::string> lines_of(const std::string& text)
{
    std::vector<std::string> lines;
    std::istringstream stream{text};
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

/// Returns the faults of one page of help: a line that is too long, an option without a text,
/// internal words of the library, no usage line that can be pasted.
inline std::vector<std::string> page_faults(const std::string& program, const std::string& page)
{
    std::vector<std::string> faults;
    const auto lines = lines_of(page);
    if (!page.starts_with("Usage: " + program)) faults.push_back("no usage line of " + program);
    if (page.find("\nExit codes:\n") == std::string::npos) faults.emplace_back("no exit codes");
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::string& line = lines[i];
        if (line.size() > 80) faults.push_back("longer than 80 columns: " + line);
        for (const char* noise : {"REQUIRED", "Excludes:", "Needs:", "TEXT", " x 2"}) {
            if (line.find(noise) != std::string::npos) faults.push_back(noise + (": " + line));
        }
        const bool is_option = line.starts_with("  -");
        const bool has_text = line.find("  ", 3) != std::string::npos;
        const bool goes_on = i + 1 < lines.size() && lines[i + 1].starts_with("          ");
        if (is_option && !has_text && !goes_on) faults.push_back("without a text: " + line);
    }
    return faults;
}

/// The commands that a page of help lists.
inline std::vector<std::string> listed_commands(const std::string& page)
{
    std::vector<std::string> names;
    bool is_in_list = false;
    for (const std::string& line : lines_of(page)) {
        if (line.empty()) is_in_list = false;
        if (is_in_list && line.size() > 2 && line[2] != ' ') {
            names.push_back(line.substr(2, line.find(' ', 2) - 2));
        }
        if (line.starts_with("Commands (")) is_in_list = true;
    }
    return names;
}

/// Returns the faults of a program's help: of its own page, of each command's page, and of the ways
/// to ask for them.
inline std::vector<std::string> help_faults(const std::string& program, const Prints& prints)
{
    const auto page = prints({"--help"});
    if (!page) return {"--help prints nothing"};
    std::vector<std::string> faults = page_faults(program, *page);
    if (page->find("\nExamples:\n") == std::string::npos) faults.emplace_back("no examples");
    for (const char* other : {"-h", "help"}) {
        if (prints({other}) != page) faults.push_back(std::string{other} + " is not --help");
    }
    const auto version = prints({"--version"});
    if (!version || !version->starts_with(program + " ")) faults.emplace_back("no --version");
    if (prints({"-V"}) != version) faults.emplace_back("-V is not --version");
    for (const std::string& name : listed_commands(*page)) {
        const auto of_command = prints({name, "--help"});
        if (!of_command) return {name + " --help prints nothing"};
        for (const std::string& fault : page_faults(program, *of_command)) {
            faults.push_back(name + ": " + fault);
        }
        if (of_command->find(" " + name) == std::string::npos)
            faults.push_back(name + ": no usage");
        if (prints({"help", name}) != of_command) faults.push_back("help " + name + " differs");
    }
    return faults;
}

/// Returns the text that `parse`, a program's parser of command lines, produces for words.
template <typename Parse>
[[nodiscard]] Prints prints_of(std::string program, Parse parse)
{
    return [program, parse](std::vector<std::string> words) -> std::optional<std::string> {
        Typed typed{program, std::move(words)};
        const auto line = parse(typed.words());
        if (!line || line->index() == 0) return std::nullopt;
        return std::get<1>(*line).text;
    };
}

/// Returns the complaint of `parse` about words; "" where it accepts them.
template <typename Parse>
[[nodiscard]] std::string refusal_of(Parse parse, const std::string& program,
                                     std::vector<std::string> words)
{
    Typed typed{program, std::move(words)};
    const auto line = parse(typed.words());
    return line ? "" : line.error().message;
}

} // namespace hapnet::cli
