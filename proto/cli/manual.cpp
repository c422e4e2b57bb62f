// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/cli/manual.hpp"

#include "proto/base/version.hpp"
#include "proto/cli/help.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <string_view>

namespace hapnet::cli {

namespace {

/// Puts backslashes before characters that scdoc takes for marks of its own.
std::string escaped(std::string_view text)
{
    std::string out;
    for (const char c : text) {
        if (std::string_view{"\\*_`#<>[]|.-;+~'"}.find(c) != std::string_view::npos) out += '\\';
        out += c;
    }
    return out;
}

std::string bold(std::string_view text) { return fmt::format("*{}*", escaped(text)); }

/// Formats prose. Lines that begin with a space are unchanged.
std::string prose(std::string_view text)
{
    std::string out;
    bool is_literal = false;
    const auto set_literal = [&](bool literal) {
        if (literal != is_literal) out += "```\n";
        is_literal = literal;
    };
    while (!text.empty()) {
        const auto end = std::min(text.find('\n'), text.size());
        const auto line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (!line.empty()) set_literal(line.front() == ' ');
        out += (is_literal ? std::string{line} : escaped(line)) + "\n";
    }
    set_literal(false);
    return out;
}

std::string item(const std::string& names, std::string_view help)
{
    std::string text = names + "\n";
    const std::string lines = prose(help);
    for (std::size_t begin = 0; begin < lines.size();) {
        const auto end = lines.find('\n', begin);
        text += "\t" + lines.substr(begin, end + 1 - begin);
        begin = end + 1;
    }
    return text + "\n";
}

std::string option_names(const Option& option)
{
    std::string names;
    for (std::string_view rest = option.names; !rest.empty();) {
        const auto end = std::min(rest.find(','), rest.size());
        names += (names.empty() ? "" : ", ") + bold(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return option.value.empty() ? names : names + " " + escaped(option.value);
}

std::string option_items(const Command& command)
{
    std::string text;
    for (const Option& option : command.options()) {
        if (option.is_hidden) continue;
        const char* note = option.is_required() && !option.is_positional() ? " (required)" : "";
        text += item(option_names(option), option.help + note);
    }
    return text;
}

std::string section(std::string_view heading, const std::string& text)
{
    return text.empty() ? "" : fmt::format("# {}\n\n{}\n", heading, text);
}

std::string about(const Command& command)
{
    return prose(command.description().empty() ? command.summary() : command.description());
}

std::string command_text(const Command& command)
{
    std::string text = fmt::format("## {}\n\n{}\n\n{}\n{}", escaped(command.name()),
                                   bold(usage(command)), about(command), option_items(command));
    if (!command.footer().empty()) text += prose(command.footer()) + "\n";
    return text;
}

} // namespace

std::string manual(const Command& program)
{
    const auto& description = program.description();
    const auto summary = description.substr(0, description.find('.'));
    std::string text = fmt::format("{}(1) \"\" \"Hapnet {}\"\n\n", program.name(), base::version());
    std::string name = summary;
    std::replace(name.begin(), name.end(), '\n', ' ');
    text += section("NAME", fmt::format("{} - {}\n", program.name(), escaped(name)));
    std::string synopsis = bold(usage(program)) + "\n";
    if (!program.commands().empty() && !program.needs_command()) {
        synopsis += "\n" + bold(program.path() + " COMMAND ...") + "\n";
    }
    text += section("SYNOPSIS", synopsis);
    text += section("DESCRIPTION", about(program));
    text += section("OPTIONS",
                    option_items(program) + item("*-h*, *--help*", "Print help and exit") +
                        item("*-V*, *--version*", "Print version, commit and compiler, and exit"));
    std::string commands;
    for (const Command& one : program.commands()) commands += command_text(one);
    text += section("COMMANDS", commands);
    text += section("NOTES", prose(program.footer()));
    text += section("EXIT STATUS", prose(program.exit_codes()));
    return text;
}

} // namespace hapnet::cli
