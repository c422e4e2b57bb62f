// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/cli/command.hpp"

#include "proto/base/quantity.hpp"
#include "proto/base/version.hpp"
#include "proto/cli/completion.hpp"
#include "proto/cli/help.hpp"
#include "proto/cli/manual.hpp"
#include "proto/cli/synonyms.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::cli {

namespace {

using Words = std::vector<std::string>;

constexpr std::array<std::string_view, 2> help_words{"-h", "--help"};
constexpr std::array<std::string_view, 2> version_words{"-V", "--version"};

bool is_any_of(std::span<const std::string_view> choices, std::string_view word)
{
    return std::find(choices.begin(), choices.end(), word) != choices.end();
}

/// CLI11 takes a list in brackets apart at its commas; ours are lists of a profile. A letter that
/// nobody types keeps it from that.
constexpr char guard = '\x01';

std::string guarded(std::string word)
{
    return word.starts_with('[') ? guard + std::move(word) : std::move(word);
}

std::string unguarded(std::string word)
{
    return word.starts_with(guard) ? word.substr(1) : std::move(word);
}

/// `help`, `help run` and, where the program has an argument, `SOCKET help set`, as --help.
Words without_help_word(Words words, const Command& program)
{
    const bool has_argument =
        std::any_of(program.options().begin(), program.options().end(),
                    [](const Option& option) { return option.is_positional(); });
    const std::size_t places = has_argument ? 2 : 1;
    for (std::size_t i = 0; i < std::min(places, words.size()); ++i) {
        if (words[i] != "help") continue;
        words.erase(words.begin() + static_cast<std::ptrdiff_t>(i));
        words.emplace_back("--help");
        break;
    }
    return words;
}

/// `--generate WHAT`, the first words: what packages install beside the program.
std::optional<base::Result<std::string>> generated(const Words& words, const Command& program)
{
    if (words.empty() || !words.front().starts_with(generate_word)) return std::nullopt;
    const bool is_one_word = words.front().size() > generate_word.size();
    if (is_one_word && words.front()[generate_word.size()] != '=') return std::nullopt;
    const auto what = is_one_word         ? words.front().substr(generate_word.size() + 1)
                      : words.size() == 2 ? words.back()
                                          : std::string{};
    if (what == "man") return manual(program);
    if (what == "bash") return completion(program, Shell::bash);
    if (what == "zsh") return completion(program, Shell::zsh);
    if (what == "fish") return completion(program, Shell::fish);
    return tl::unexpected{
        base::Error{fmt::format("{}: expected one of {}, and nothing else, not '{}'", generate_word,
                                generate_values, what)}};
}

/// --help and --version count wherever they stand, and whatever else is wrong with the line.
std::optional<std::string> answer(const Words& words, const Command& program)
{
    const auto end = std::find(words.begin(), words.end(), "--");
    const auto asks_for = [&](std::span<const std::string_view> choices) {
        return std::any_of(words.begin(), end,
                           [&](const std::string& word) { return is_any_of(choices, word); });
    };
    if (asks_for(help_words)) {
        const Command* asked = &program;
        for (auto word = words.begin(); word != end && asked == &program; ++word) {
            if (const Command* command = program.find_command(*word)) asked = command;
        }
        return help_text(*asked, help_columns());
    }
    if (asks_for(version_words)) return base::version_line(program.name()) + "\n";
    return std::nullopt;
}

} // namespace

/// A command with what CLI11 found for it.
class Syntax {
public:
    explicit Syntax(Command& program) : program_{program}, app_{"", program.name()}
    {
        add(program, app_);
        app_.allow_extras();
        app_.require_subcommand(0, 1);
        for (Command& command : program.commands_) {
            CLI::App& app = *app_.add_subcommand(command.name());
            for (const std::string& alias : command.aliases()) app.alias(alias);
            app.allow_extras();
            if (program.needs_command()) app.fallthrough();
            add(command, app);
        }
    }

    base::Result<void> read(Words words)
    {
        typed_ = words;
        std::transform(words.begin(), words.end(), words.begin(), guarded);
        std::reverse(words.begin(), words.end()); // as CLI11 wants it
        try {
            app_.parse(std::move(words));
        } catch (const CLI::ArgumentMismatch& error) {
            return base::fail(missing_value(error.what()));
        } catch (const CLI::ParseError& error) {
            return base::fail(error.what());
        }
        note_command();
        auto done = nothing_left();
        if (done) done = take_values(chosen());
        if (done && &chosen() != &program_ && program_.needs_command()) {
            done = take_values(program_);
        }
        if (done) done = nothing_missing(chosen());
        return done;
    }

private:
    void add(Command& command, CLI::App& app)
    {
        app.set_help_flag();
        for (Option& option : command.options_) {
            CLI::Option* added =
                option.is_flag() ? app.add_flag(option.names) : app.add_option(option.names);
            if (!option.is_flag()) {
                added->take_all();
                added->expected(option.is_positional() && option.is_repeated ? -1 : 1);
            }
            found_[&option] = added;
        }
    }

    void note_command()
    {
        const auto parsed = app_.get_subcommands();
        for (Command& command : program_.commands_) {
            command.is_chosen_ = !parsed.empty() && parsed.front()->get_name() == command.name();
            if (command.is_chosen_) chosen_ = &command;
        }
    }

    [[nodiscard]] Command& chosen() const { return chosen_ == nullptr ? program_ : *chosen_; }

    /// "--delay: 1 required TEXT missing" is what CLI11 says.
    [[nodiscard]] std::string missing_value(std::string_view what) const
    {
        const auto name = what.substr(0, what.find(':'));
        for (const auto& [option, found] : found_) {
            if (option->name() != name) continue;
            return fmt::format("{0} needs a value: {0} {1}", name, option->value);
        }
        return std::string{what};
    }

    /// Words that nothing has taken, and options that the chosen command does not have.
    [[nodiscard]] base::Result<void> nothing_left() const
    {
        const auto left = app_.remaining(/*recurse*/ true);
        const bool is_command_missing = program_.needs_command() && chosen_ == nullptr;
        for (const std::string& word : left) {
            if (word.starts_with('-') && word != "-" && word != "--") {
                return base::fail(unknown_option(chosen(), word));
            }
        }
        for (const std::string& guarded_word : left) {
            const std::string word = unguarded(guarded_word);
            if (word == "--") continue;
            if (auto split = split_value(word)) return base::fail(*std::move(split));
            if (chosen_ == nullptr && !program_.commands().empty()) {
                return base::fail(unknown_command(program_, word));
            }
            return base::fail(fmt::format("unexpected '{}': {}", word, usage(chosen())));
        }
        if (is_command_missing) return command_missing();
        if (chosen_ == nullptr || program_.needs_command()) return {};
        for (const Option& option : program_.options_) {
            if (found_.at(&option)->count() == 0) continue;
            return base::fail(unknown_option(*chosen_, option.name()));
        }
        return {};
    }

    /// What to say of the "ms" in "--delay 80 ms".
    [[nodiscard]] std::optional<std::string> split_value(const std::string& unit) const
    {
        if (!base::is_unit(unit)) return std::nullopt;
        for (std::size_t i = 1; i < typed_.size(); ++i) {
            if (typed_[i] != unit) continue;
            const auto sign = typed_[i - 1].find('=');
            const bool is_one_word = typed_[i - 1].starts_with('-') && sign != std::string::npos;
            if (!is_one_word && (i < 2 || !typed_[i - 2].starts_with("--"))) continue;
            const auto name = is_one_word ? typed_[i - 1].substr(0, sign) : typed_[i - 2];
            const auto value = is_one_word ? typed_[i - 1].substr(sign + 1) : typed_[i - 1];
            if (value.empty() || value.find_first_not_of("0123456789.-+") != std::string::npos) {
                continue;
            }
            return fmt::format("{0}: '{1} {2}' has a space: write {1}{2}", name, value, unit);
        }
        return std::nullopt;
    }

    [[nodiscard]] base::Result<void> command_missing() const
    {
        // What stands where a command belongs may have been taken for the program's argument.
        for (const Option& option : program_.options_) {
            const auto& texts = found_.at(&option)->results();
            if (option.is_positional() && !texts.empty() &&
                !command_meant(program_, texts.front()).empty()) {
                return base::fail(unknown_command(program_, texts.front()));
            }
        }
        std::vector<std::string_view> names;
        for (const Command& command : program_.commands()) names.push_back(command.name());
        return base::fail(fmt::format("a command is required: {}, with one of {}", usage(program_),
                                      fmt::join(names, ", ")));
    }

    [[nodiscard]] base::Result<void> take_values(Command& command)
    {
        for (Option& option : command.options_) {
            const auto& texts = found_.at(&option)->results();
            option.is_given = !texts.empty();
            if (texts.size() > 1 && !option.is_repeated && !option.is_flag()) {
                return base::fail(
                    fmt::format("{} is given {} times: give it once", option.name(), texts.size()));
            }
            for (const std::string& text : texts) {
                if (auto split = option.is_positional() ? split_value(text) : std::nullopt) {
                    return base::fail(*std::move(split));
                }
                if (const auto taken = option.take(unguarded(text)); !taken) {
                    return base::fail(fmt::format("{}: {}", option.name(), taken.error().message));
                }
            }
        }
        return {};
    }

    /// After everything else: a mistyped option is not a missing one.
    [[nodiscard]] static base::Result<void> nothing_missing(const Command& command)
    {
        const auto& options = command.options();
        if (std::any_of(options.begin(), options.end(), [](const Option& option) {
                return option.is_instead && option.is_given;
            })) {
            return {};
        }
        for (const Option& option : options) {
            if (!option.is_required() || option.is_given) continue;
            return base::fail(
                option.is_positional()
                    ? fmt::format("{} is required: {} {}", option.names, command.path(),
                                  option.example)
                    : fmt::format("{0} is required: {0} {1}", option.name(), option.example));
        }
        return {};
    }

    Command& program_;
    Words typed_;
    Command* chosen_ = nullptr; // nullptr: the program itself
    CLI::App app_;
    std::map<const Option*, CLI::Option*> found_;
};

Command::Command(std::string name, std::string summary)
    : name_{std::move(name)}, summary_{std::move(summary)}
{}

Option& Command::option(std::string names, std::string value, std::string help, Take take)
{
    options_.push_back({std::move(names), std::move(value), std::move(help), std::move(take)});
    return options_.back();
}

Option& Command::flag(std::string names, std::string help, bool& target)
{
    return option(std::move(names), "", std::move(help),
                  [&target](const std::string&) -> base::Result<void> {
                      target = true;
                      return {};
                  });
}

Option& Command::positional(std::string name, std::string help, Take take)
{
    return option(std::move(name), "", std::move(help), std::move(take)).under("Arguments");
}

Command& Command::command(std::string name, std::string summary)
{
    Command& added = commands_.emplace_back(std::move(name), std::move(summary));
    added.parent_ = this;
    return added;
}

base::Result<std::optional<std::string>> Command::parse(std::span<char*> words)
{
    const auto behind_name = words.subspan(std::min<std::size_t>(words.size(), 1));
    const Words typed = without_help_word({behind_name.begin(), behind_name.end()}, *this);
    if (auto text = answer(typed, *this)) return text;
    if (auto text = generated(typed, *this)) {
        if (!*text) return tl::unexpected{text->error()};
        return std::optional{*std::move(*text)};
    }
    if (const auto read = Syntax{*this}.read(typed); !read) return tl::unexpected{read.error()};
    return std::nullopt;
}

bool Command::is_given(std::string_view option_name) const
{
    return std::any_of(options_.begin(), options_.end(), [&](const Option& option) {
        return option.name() == option_name && option.is_given;
    });
}

std::string Command::path() const
{
    if (parent_ == nullptr) return name_;
    std::string path = parent_->path();
    for (const Option& option : parent_->options()) {
        if (option.is_positional()) path += " " + option.names;
    }
    return path + " " + name_;
}

const Command* Command::find_command(std::string_view name) const
{
    for (const Command& command : commands_) {
        const auto& aliases = command.aliases();
        if (command.name() == name ||
            std::find(aliases.begin(), aliases.end(), name) != aliases.end()) {
            return &command;
        }
    }
    return nullptr;
}

} // namespace hapnet::cli
