// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/cli/option.hpp"

#include <list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::cli {

/// A program's command line, or one of its commands. Options are bound to the variables that their
/// values are stored in. The class looks nothing up and opens nothing, except what its parsers do.
///
/// -h, --help, `help`, `help COMMAND`, -V and --version are always understood and need not be
/// added. The error for an unknown option or command suggests the one that was probably meant.
class Command {
public:
    /// `name` is the word to type: "hapnet-lab", and "run" for its command. The program's --help
    /// shows the summary beside the name.
    explicit Command(std::string name, std::string summary = "");

    /// Sets the text that --help shows above the options. Lines are filled to the width of the
    /// terminal, except lines that begin with a space. add_footer() sets the text below the
    /// options.
    void describe(std::string text) { description_ = std::move(text); }
    void add_footer(std::string text) { footer_ = std::move(text); }
    /// Sets the exit codes that --help shows, one per line: "  0  done". Commands without their own
    /// list show the list of the program.
    void add_exit_codes(std::string text) { exit_codes_ = std::move(text); }
    /// Sets the end of the usage line: "-- COMMAND [ARGUMENT ...]". parse() never sees these words.
    void add_usage(std::string words) { usage_end_ = std::move(words); }

    Option& option(std::string names, std::string value, std::string help, Take take);
    Option& flag(std::string names, std::string help, bool& target);
    /// Adds a positional argument. Positionals are filled in the order in which they were added; a
    /// repeated one must be the last.
    Option& positional(std::string name, std::string help, Take take);

    Command& command(std::string name, std::string summary);
    /// Requires that one of the program's commands is given. The program's own options then apply
    /// to all commands. Otherwise they apply only if no command is given.
    void require_command() { needs_command_ = true; }
    /// Adds another spelling of the command, which --help does not show.
    void add_alias(std::string alias) { aliases_.push_back(std::move(alias)); }

    /// Parses a program's command line; words[0] is the program's name. Returns a text if one is to
    /// be printed instead of running, as for --help or --version. nullopt: all values have been
    /// stored.
    [[nodiscard]] base::Result<std::optional<std::string>> parse(std::span<char*> words);

    /// True if parse() found this command or option in the command line.
    [[nodiscard]] bool is_chosen() const { return is_chosen_; }
    [[nodiscard]] bool is_given(std::string_view option_name) const;

    // Parts of the output of --help.

    /// Returns the full command as it is typed: "hapnet-lab run".
    [[nodiscard]] std::string path() const;
    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] const std::string& summary() const { return summary_; }
    [[nodiscard]] const std::string& description() const { return description_; }
    [[nodiscard]] const std::string& footer() const { return footer_; }
    [[nodiscard]] const std::string& exit_codes() const
    {
        return exit_codes_.empty() && parent_ != nullptr ? parent_->exit_codes() : exit_codes_;
    }
    [[nodiscard]] const std::string& usage_end() const { return usage_end_; }
    [[nodiscard]] bool needs_command() const { return needs_command_; }
    [[nodiscard]] const Command* parent() const { return parent_; }
    [[nodiscard]] const std::vector<std::string>& aliases() const { return aliases_; }
    [[nodiscard]] const std::list<Option>& options() const { return options_; }
    [[nodiscard]] const std::list<Command>& commands() const { return commands_; }
    [[nodiscard]] const Command* find_command(std::string_view name) const;

private:
    friend class Syntax;

    std::string name_;
    std::string summary_;
    std::string description_;
    std::string footer_;
    std::string exit_codes_;
    std::string usage_end_;
    bool needs_command_ = false;
    bool is_chosen_ = false;
    const Command* parent_ = nullptr;
    std::vector<std::string> aliases_;
    std::list<Option> options_; // a list, because addresses must stay valid
    std::list<Command> commands_;
};

} // namespace hapnet::cli
