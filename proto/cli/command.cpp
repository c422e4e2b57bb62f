// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/cli/command.hpp"

#include "proto/base/quantity.hpp"
#include "proto/base/version.hpp"
#include "proto/cli/completion.hpp"
#include "proto/cli/help.hpp"
#include "proto/cli/manual.hpp"
#include "proto/cli/synonyms.hpp"

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

/// Replaces `help`, `help run` and, if the program has an argument, `SOCKET help set`, by --help.
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

/// Handles `--generate WHAT` as the first words. It prints files that packages install with the
/// program.
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

/// --help and --version take effect at any place, even if the line has errors.
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

/// Assigns a program's words: the chosen command, and the values of each option.
class Syntax {
public:
    explicit Syntax(Command& program) : program_{program} {}

    base::Result<void> read(Words words)
    {
        typed_ = std::move(words);
        if (auto sorted = sort(); !sorted) return sorted;
        for (Command& command : program_.commands_) command.is_chosen_ = &command == chosen_;
        auto done = nothing_left();
        if (done) done = take_values(chosen());
        if (done && &chosen() != &program_ && program_.needs_command()) {
            done = take_values(program_);
        }
        if (done) done = nothing_missing(chosen());
        return done;
    }

private:
    /// Assigns the words. The first word that is the name of a command chooses it. All words after
    /// "--" are arguments.
    base::Result<void> sort()
    {
        bool are_arguments = false;
        while (next_ < typed_.size()) {
            const std::string word = typed_[next_++];
            Command* const command = chosen_ == nullptr ? command_of(word) : nullptr;
            if (!are_arguments && word == "--") {
                are_arguments = true;
            } else if (!are_arguments && command != nullptr) {
                chosen_ = command;
            } else if (!are_arguments && is_option(word)) {
                if (auto taken = take_option(word); !taken) return taken;
            } else {
                take_argument(word);
            }
        }
        return {};
    }

    [[nodiscard]] Command* command_of(const std::string& word) const
    {
        for (Command& command : program_.commands_) {
            const auto& aliases = command.aliases();
            const bool is_alias = std::find(aliases.begin(), aliases.end(), word) != aliases.end();
            if (command.name() == word || is_alias) return &command;
        }
        return nullptr;
    }

    /// Calls look(options) for each set of options that is allowed here, until it returns one.
    template <typename Look>
    [[nodiscard]] Option* look_here(const Look& look) const
    {
        Option* found = look(chosen().options_);
        const bool has_more = chosen_ != nullptr && program_.needs_command();
        return found == nullptr && has_more ? look(program_.options_) : found;
    }

    /// Returns the option "-s" or "--socket"; nullptr if there is none with that name here.
    [[nodiscard]] Option* option_of(std::string_view name) const
    {
        return look_here([name](std::list<Option>& options) -> Option* {
            for (Option& option : options) {
                if (option.is_positional()) continue;
                const auto comma = option.names.find(',');
                const bool is_short =
                    comma != std::string::npos && option.names.compare(0, comma, name) == 0;
                if (is_short || option.name() == name) return &option;
            }
            return nullptr;
        });
    }

    /// True for an option. A number with a sign is not an option.
    [[nodiscard]] bool is_option(const std::string& word) const
    {
        if (word.size() < 2 || word[0] != '-') return false;
        const bool is_digit = word[1] >= '0' && word[1] <= '9';
        return !is_digit || option_of(word.substr(0, 2)) != nullptr;
    }

    /// Takes `--delay 1ms`, `--delay=1ms`, `-d 1ms`, `-d1ms` and `-d=1ms`.
    base::Result<void> take_option(const std::string& word)
    {
        const bool is_long = word.starts_with("--");
        const auto sign = word.find('=');
        const std::string name = word.substr(0, is_long ? sign : 2);
        Option* const option = option_of(name);
        if (option == nullptr) {
            unknown_.push_back(word);
            return {};
        }
        std::string behind = word.substr(name.size());
        const bool has_sign = behind.starts_with('=');
        if (option->is_flag()) {
            if (has_sign) return base::fail(fmt::format("{} takes no value", option->name()));
            found_[option].emplace_back();
            // Several flags in one word: "-qv".
            return behind.empty() ? base::Result<void>{} : take_option('-' + behind);
        }
        if (has_sign) behind.erase(0, 1);
        const bool is_next = behind.empty() && !has_sign && next_ < typed_.size();
        if (behind.empty() && !is_next) {
            return base::fail(
                fmt::format("{0} needs a value: {0} {1}", option->name(), option->value));
        }
        found_[option].push_back(is_next ? typed_[next_++] : std::move(behind));
        return {};
    }

    void take_argument(const std::string& word)
    {
        Option* const argument = look_here([this](std::list<Option>& options) -> Option* {
            for (Option& option : options) {
                const bool has_room = option.is_repeated || !found_.contains(&option);
                if (option.is_positional() && has_room) return &option;
            }
            return nullptr;
        });
        is_rest_first_ = is_rest_first_ || (argument == nullptr && unknown_.empty());
        (argument == nullptr ? rest_ : found_[argument]).push_back(word);
    }

    [[nodiscard]] const Words& texts_of(const Option& option) const
    {
        static const Words none;
        const auto found = found_.find(&option);
        return found == found_.end() ? none : found->second;
    }

    [[nodiscard]] Command& chosen() const { return chosen_ == nullptr ? program_ : *chosen_; }

    /// Refuses arguments that no positional takes, and options that the chosen command does not
    /// have.
    [[nodiscard]] base::Result<void> nothing_left() const
    {
        const bool is_command_missing = program_.needs_command() && chosen_ == nullptr;
        // The words of a command to run, in a place where options may be.
        if (is_rest_first_ && chosen().usage_end().starts_with("-- ")) {
            return base::fail(
                fmt::format("'{}' is not an option: put -- before the command that is "
                            "to run: {}",
                            rest_.front(), usage(chosen())));
        }
        if (!unknown_.empty()) return base::fail(unknown_option(chosen(), unknown_.front()));
        for (const std::string& word : rest_) {
            if (auto split = split_value(word)) return base::fail(*std::move(split));
            if (chosen_ == nullptr && !program_.commands().empty()) {
                return base::fail(unknown_command(program_, word));
            }
            return base::fail(fmt::format("unexpected '{}': {}", word, usage(chosen())));
        }
        if (is_command_missing) return command_missing();
        if (chosen_ == nullptr || program_.needs_command()) return {};
        for (const Option& option : program_.options_) {
            if (texts_of(option).empty()) continue;
            return base::fail(unknown_option(*chosen_, option.name()));
        }
        return {};
    }

    /// Returns the hint on the "ms" in "--delay 80 ms".
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
        // A misspelt command may have been taken as the program's argument.
        for (const Option& option : program_.options_) {
            const Words& texts = texts_of(option);
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
            const Words& texts = texts_of(option);
            option.is_given = !texts.empty();
            if (texts.size() > 1 && !option.is_repeated && !option.is_flag()) {
                return base::fail(
                    fmt::format("{} is given {} times: give it once", option.name(), texts.size()));
            }
            for (const std::string& text : texts) {
                if (auto split = option.is_positional() ? split_value(text) : std::nullopt) {
                    return base::fail(*std::move(split));
                }
                if (const auto taken = option.take(text); !taken) {
                    return base::fail(fmt::format("{}: {}", option.name(), taken.error().message));
                }
            }
        }
        return {};
    }

    /// Refuses missing options. Call it after all other checks, so that a mistyped option is not
    /// reported as a missing one.
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
    std::size_t next_ = 0;      // index of the next typed word to sort
    Command* chosen_ = nullptr; // nullptr: the program itself
    std::map<const Option*, Words> found_;
    Words unknown_;              // options that do not exist
    Words rest_;                 // arguments that nothing takes
    bool is_rest_first_ = false; // rest_ began before any unknown option
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
    // A command that has commands parses the words after it.
    for (Command& command : commands_) {
        if (!command.commands_.empty() && !behind_name.empty() &&
            command.name() == behind_name.front())
            return command.parse(behind_name);
    }
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
