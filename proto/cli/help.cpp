// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/cli/help.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <sys/ioctl.h>
#include <unistd.h>
#include <vector>

namespace hapnet::cli {

namespace {

constexpr std::size_t columns_without_terminal = 80;
constexpr std::size_t columns_min = 40;
constexpr std::size_t columns_max = 100; // longer lines are hard to read
constexpr std::size_t names_width = 26;  // width of the left column

/// Breaks words into lines of at most `columns`. The first line continues a line that already has
/// `column` characters.
std::string folded(std::string_view words, std::size_t column, std::size_t indent,
                   std::size_t columns)
{
    std::string text;
    while (!words.empty()) {
        const auto space = std::min(words.find(' '), words.size());
        const auto word = words.substr(0, space);
        words.remove_prefix(std::min(space + 1, words.size()));
        if (word.empty()) continue;
        const bool is_first = column <= indent;
        if (!is_first && column + 1 + word.size() > columns) {
            text += "\n" + std::string(indent, ' ');
            column = indent;
        } else if (!is_first) {
            text += ' ';
            ++column;
        }
        text += word;
        column += word.size();
    }
    return text;
}

/// Returns the position of the second column in "  name   what it is"; npos if there is none.
std::size_t second_column(std::string_view line)
{
    const auto name = line.find_first_not_of(' ');
    const auto gap = line.find("  ", name);
    return gap == std::string_view::npos ? gap : line.find_first_not_of(' ', gap);
}

/// Formats a line that begins with a space.
std::string kept(std::string_view line, std::size_t indent, std::size_t columns)
{
    const std::string margin(indent, ' ');
    const auto column = second_column(line);
    if (column == std::string_view::npos || indent + line.size() <= columns) {
        return margin + std::string{line};
    }
    return margin + std::string{line.substr(0, column)} +
           folded(line.substr(column), indent + column, indent + column, columns);
}

std::vector<std::string_view> lines_of(std::string_view text)
{
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const auto end = std::min(text.find('\n'), text.size());
        lines.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

/// Returns "  --delay TIME            What it does", wrapped below its second column.
std::string row(const std::string& name, std::string_view help, std::size_t columns)
{
    std::string text = "  " + name;
    const bool fits = text.size() + 2 <= names_width;
    text +=
        fits ? std::string(names_width - text.size(), ' ') : "\n" + std::string(names_width, ' ');
    // The first line already has its margin.
    return text + filled(help, names_width, columns).substr(names_width) + "\n";
}

std::string left_column(const Option& option)
{
    std::string names;
    for (const char c : option.names) names += c == ',' ? ", " : std::string{c};
    if (!option.value.empty()) names += " " + option.value;
    return names;
}

std::string group_text(const Command& command, const std::string& group, std::size_t columns)
{
    std::string text = fmt::format("\n{}:\n", group);
    for (const Option& option : command.options()) {
        if (option.is_hidden || option.group != group) continue;
        const char* note = option.is_required() && !option.is_positional() ? " (required)" : "";
        text += row(left_column(option), option.help + note, columns);
    }
    if (group != "Options") return text;
    text += row("-h, --help", "Print this help and exit", columns);
    if (command.parent() != nullptr) return text;
    text += row("-V, --version", "Print version, commit and compiler, and exit", columns);
    return text + row(fmt::format("{} {}", generate_word, generate_values),
                      "Print the manual page, for scdoc, or what completes the command line in a "
                      "shell, and exit",
                      columns);
}

/// Returns the options of a program that apply to each of its commands.
std::string options_of_every(const Command& program, std::size_t columns)
{
    std::string rows;
    for (const Option& option : program.options()) {
        if (option.is_hidden || option.is_positional()) continue;
        rows += row(left_column(option), option.help, columns);
    }
    return rows.empty() ? rows : "\nOptions of every command:\n" + rows;
}

std::vector<std::string> groups_of(const Command& command)
{
    std::vector<std::string> groups;
    for (const Option& option : command.options()) {
        if (option.is_hidden ||
            std::find(groups.begin(), groups.end(), option.group) != groups.end()) {
            continue;
        }
        groups.push_back(option.group);
    }
    if (std::find(groups.begin(), groups.end(), "Options") == groups.end()) {
        groups.emplace_back("Options");
    }
    return groups;
}

} // namespace

std::string in_usage(const Option& option)
{
    std::string text = option.name();
    if (!option.value.empty()) text += " " + option.value;
    if (option.is_positional() && option.is_repeated) text += " ...";
    return option.is_required() ? text : "[" + text + "]";
}

std::size_t help_columns()
{
    winsize size{};
    const bool is_terminal =
        isatty(STDOUT_FILENO) != 0 && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0;
    if (!is_terminal || size.ws_col == 0) return columns_without_terminal;
    return std::clamp<std::size_t>(size.ws_col, columns_min, columns_max);
}

std::string filled(std::string_view text, std::size_t indent, std::size_t columns)
{
    const std::string margin(indent, ' ');
    std::string out;
    std::string paragraph;
    const auto add_line = [&](const std::string& line) { out += (out.empty() ? "" : "\n") + line; };
    const auto end_paragraph = [&] {
        if (!paragraph.empty()) add_line(margin + folded(paragraph, indent, indent, columns));
        paragraph.clear();
    };
    for (const std::string_view line : lines_of(text)) {
        if (!line.empty() && line.front() != ' ') {
            paragraph += (paragraph.empty() ? "" : " ") + std::string{line};
            continue;
        }
        end_paragraph();
        add_line(line.empty() ? "" : kept(line, indent, columns));
    }
    end_paragraph();
    return out;
}

/// Returns the path of a command, with optional parts in brackets.
std::string shown_path(const Command& command)
{
    if (command.parent() == nullptr) return command.name();
    std::string path = shown_path(*command.parent());
    for (const Option& option : command.parent()->options()) {
        if (option.is_positional()) path += " " + in_usage(option);
    }
    return path + " " + command.name();
}

std::string usage(const Command& command)
{
    constexpr std::size_t shown_max = 2; // more optional ones appear as "[OPTIONS]"
    std::string text = shown_path(command);
    std::string optional;
    std::size_t optional_count = 0;
    for (const Option& option : command.options()) {
        if (option.is_positional() || option.is_required()) {
            text += " " + in_usage(option);
        } else if (!option.is_hidden) {
            optional += " " + in_usage(option);
            ++optional_count;
        }
    }
    if (command.needs_command()) return text + " COMMAND ...";
    text += optional_count > shown_max ? " [OPTIONS]" : optional;
    return command.usage_end().empty() ? text : text + " " + command.usage_end();
}

std::string help_text(const Command& command, std::size_t columns)
{
    constexpr std::string_view label = "Usage: ";
    const std::string margin(label.size(), ' ');
    const std::string line = usage(command);
    std::string text = std::string{label} + folded(line, label.size(), label.size() + 4, columns);
    text += "\n";
    if (!command.commands().empty() && !command.needs_command()) {
        text += margin + command.path() + " COMMAND ...\n";
    }
    const std::string& about =
        command.description().empty() ? command.summary() : command.description();
    if (!about.empty()) text += "\n" + filled(about, 0, columns) + "\n";
    if (!command.commands().empty()) {
        text += fmt::format("\nCommands ({} COMMAND --help says more):\n", command.path());
        for (const Command& one : command.commands()) {
            text += row(one.name(), one.summary(), columns);
        }
    }
    for (const std::string& group : groups_of(command)) {
        text += group_text(command, group, columns);
    }
    if (const Command* parent = command.parent(); parent != nullptr && parent->needs_command()) {
        text += options_of_every(*parent, columns);
    }
    if (!command.footer().empty()) text += "\n" + filled(command.footer(), 0, columns) + "\n";
    if (command.exit_codes().empty()) return text;
    return text + "\nExit codes:\n" + filled(command.exit_codes(), 0, columns) + "\n";
}

} // namespace hapnet::cli
