// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/cli/completion.hpp"

#include <algorithm>
#include <cctype>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <vector>

namespace hapnet::cli {

namespace {

using Words = std::vector<std::string>;

Words parts_of(std::string_view text, char at)
{
    Words words;
    while (!text.empty()) {
        const auto end = std::min(text.find(at), text.size());
        words.emplace_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return words;
}

/// Returns the words that can be typed for a value: "eco" and "precise" of "eco|precise|TIME".
Words choices(const Option& option)
{
    Words words = parts_of(option.value, '|');
    std::erase_if(words, [](const std::string& word) {
        return word.empty() || !std::all_of(word.begin(), word.end(), [](unsigned char c) {
                   return std::islower(c) != 0 || std::isdigit(c) != 0 || c == '-';
               });
    });
    return words;
}

/// Returns the options that are accepted where a command is typed, without its arguments.
std::vector<const Option*> understood(const Command& command)
{
    std::vector<const Option*> all;
    const auto add = [&](const Command& of) {
        for (const Option& option : of.options()) {
            if (!option.is_hidden && !option.is_positional()) all.push_back(&option);
        }
    };
    add(command);
    if (command.parent() != nullptr && command.parent()->needs_command()) add(*command.parent());
    return all;
}

/// Returns all spellings of a command and of its commands.
Words spellings(const Command& command)
{
    Words names;
    for (const Option* option : understood(command)) {
        for (std::string& name : parts_of(option->names, ',')) names.push_back(std::move(name));
    }
    names.insert(names.end(), {"-h", "--help"});
    if (command.parent() == nullptr) names.insert(names.end(), {"-V", "--version"});
    return names;
}

Words names_of_commands(const Command& program)
{
    Words names;
    for (const Command& one : program.commands()) names.push_back(one.name());
    return names;
}

std::string identifier(const std::string& name)
{
    std::string text = "_" + name;
    std::replace(text.begin(), text.end(), '-', '_');
    return text;
}

/// Puts a text between single quotes, for any of the shells.
std::string in_quotes(std::string_view text)
{
    std::string out = "'";
    for (const char c : text) {
        if (c == '\'') {
            out += "'\\''";
        } else {
            out += c == '\n' ? ' ' : c;
        }
    }
    return out + "'";
}

// --- bash ------------------------------------------------------------------------------------

/// Returns a case for each option that takes one of a set of words.
std::string bash_values(const Command& command)
{
    std::string text;
    for (const Option* option : understood(command)) {
        if (option->is_flag()) continue;
        const auto words = choices(*option);
        const auto names = fmt::format("{}", fmt::join(parts_of(option->names, ','), "|"));
        text +=
            words.empty()
                ? fmt::format("        {}) return ;;\n", names)
                : fmt::format("        {}) COMPREPLY=($(compgen -W {} -- \"$word\")); return ;;\n",
                              names, in_quotes(fmt::format("{}", fmt::join(words, " "))));
    }
    return text.empty() ? "" : "        case $before in\n" + text + "        esac\n";
}

std::string bash_case(const Command& command, const std::string& pattern)
{
    Words words = spellings(command);
    if (command.parent() == nullptr) {
        const auto commands = names_of_commands(command);
        words.insert(words.end(), commands.begin(), commands.end());
    }
    return fmt::format("    {})\n{}        words={}\n        ;;\n", pattern, bash_values(command),
                       in_quotes(fmt::format("{}", fmt::join(words, " "))));
}

std::string bash(const Command& program)
{
    std::string cases;
    for (const Command& one : program.commands()) cases += bash_case(one, one.name());
    cases += bash_case(program, "*");
    constexpr std::string_view body = R"({0}() {{
    local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} command= words i
    COMPREPLY=()
    for ((i = 1; i < COMP_CWORD; ++i)); do
        case ${{COMP_WORDS[i]}} in {1}) command=${{COMP_WORDS[i]}} && break ;; esac
    done
    case $command in
{2}    esac
    [[ $word == -* || -z $command ]] && COMPREPLY=($(compgen -W "$words" -- "$word"))
}}
complete -o default -F {0} {3}
)";
    const auto commands = names_of_commands(program);
    return fmt::format(body, identifier(program.name()),
                       commands.empty() ? "''" : fmt::format("{}", fmt::join(commands, "|")), cases,
                       program.name());
}

// --- zsh -------------------------------------------------------------------------------------

/// Escapes brackets, colons and backslashes, which have a meaning in a specification of _arguments.
std::string in_brackets(std::string_view text)
{
    std::string out;
    for (const char c : text) {
        if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
        out += c;
    }
    return out;
}

std::string zsh_arguments(const Command& command)
{
    std::string text;
    const auto add = [&](const std::string& specification) {
        text += " \\\n            " + in_quotes(specification);
    };
    for (const Option* option : understood(command)) {
        const auto words = choices(*option);
        const auto action =
            words.empty() ? std::string{"_files"} : fmt::format("({})", fmt::join(words, " "));
        const auto value =
            option->is_flag() ? "" : fmt::format(":{}:{}", in_brackets(option->value), action);
        for (const std::string& name : parts_of(option->names, ',')) {
            add(fmt::format("{}{}[{}]{}", option->is_repeated ? "*" : "", name,
                            in_brackets(option->help), value));
        }
    }
    add("--help[Print help and exit]");
    if (command.parent() == nullptr) add("--version[Print version, commit and compiler, and exit]");
    add("*:file:_files");
    return text;
}

std::string zsh(const Command& program)
{
    std::string commands;
    std::string cases;
    for (const Command& one : program.commands()) {
        commands += fmt::format("        {}\n", in_quotes(one.name() + ":" + one.summary()));
        cases += fmt::format("    {})\n        _arguments{}\n        ;;\n", one.name(),
                             zsh_arguments(one));
    }
    constexpr std::string_view body = R"(#compdef {0}
{1}() {{
    local -a commands=(
{2}    )
    local word command=
    for word in ${{words[2,CURRENT-1]}}; do
        (( ${{commands[(I)$word:*]}} )) && command=$word && break
    done
    case $command in
{3}    *)
        (( $#commands )) && _describe command commands
        _arguments{4}
        ;;
    esac
}}
{1} "$@"
)";
    return fmt::format(body, program.name(), identifier(program.name()), commands, cases,
                       zsh_arguments(program));
}

// --- fish ------------------------------------------------------------------------------------

std::string fish_options(const Command& command, const std::string& start)
{
    std::string text;
    for (const Option* option : understood(command)) {
        std::string line = start;
        for (const std::string& name : parts_of(option->names, ',')) {
            line += name.starts_with("--") ? " -l " + name.substr(2)
                    : name.size() == 2     ? " -s " + name.substr(1)
                                           : " -o " + name.substr(1);
        }
        const auto words = choices(*option);
        if (!option->is_flag()) line += words.empty() ? " -r" : " -x";
        if (!words.empty()) line += " -a " + in_quotes(fmt::format("{}", fmt::join(words, " ")));
        text += line + " -d " + in_quotes(option->help) + "\n";
    }
    return text;
}

std::string fish(const Command& program)
{
    const auto start = "complete -c " + program.name();
    const auto names = fmt::format("{}", fmt::join(names_of_commands(program), " "));
    std::string text = start + " -s h -l help -d 'Print help and exit'\n";
    text += start + " -s V -l version -d 'Print version, commit and compiler, and exit'\n";
    const bool has_commands = !program.commands().empty();
    const auto none_yet =
        has_commands ? fmt::format("{} -n 'not __fish_seen_subcommand_from {}'", start, names)
                     : start;
    for (const Command& one : program.commands()) {
        text += fmt::format("{} -a {} -d {}\n", none_yet, one.name(), in_quotes(one.summary()));
        text += fish_options(
            one, fmt::format("{} -n '__fish_seen_subcommand_from {}'", start, one.name()));
    }
    return text + fish_options(program, none_yet);
}

} // namespace

std::string completion(const Command& program, Shell shell)
{
    switch (shell) {
    case Shell::bash: return bash(program);
    case Shell::zsh: return zsh(program);
    case Shell::fish: break;
    }
    return fish(program);
}

} // namespace hapnet::cli
