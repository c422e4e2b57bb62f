// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/formats.hpp"
#include "proto/base/result.hpp"

#include <functional>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hapnet::cli {

/// Takes what stands behind an option. The error says what is wrong with the text and what would be
/// right; the option's name is put before it.
using Take = std::function<base::Result<void>(const std::string& text)>;

/// Puts into `target` what `parse` makes of the text. `parse` gives a base::Result.
template <typename Target, typename Parse>
[[nodiscard]] Take into(Target& target, Parse parse)
{
    return [&target, parse](const std::string& text) -> base::Result<void> {
        auto value = parse(text);
        if (!value) return tl::unexpected{value.error()};
        target = static_cast<Target>(*std::move(value));
        return {};
    };
}

/// Parses a text by a format (proto/base/formats.hpp). The error names the values that the format
/// accepts.
template <typename T, base::FormatOf<T> Format>
[[nodiscard]] base::Result<T> value_of(const Format& format, const std::string& text)
{
    base::Reading reading{"", {}, /*has_lines*/ false};
    const auto node = base::parse_option(
        text, requires { Format::is_bare; });
    if (!node) return base::fail(fmt::format("expected {}, not '{}'", format.describe(), text));
    T value{};
    format.read(*node, value, reading);
    if (reading.is_good()) return value;
    return base::fail(reading.complaint()->substr(2)); // skips the empty name and its colon
}

/// Puts into `target` what the text says by a format.
template <typename Target, typename Format>
requires base::FormatOf<Format, base::WithoutOptional<Target>>
[[nodiscard]] Take into(Target& target, Format format)
{
    return into(target, [format](const std::string& text) {
        return value_of<base::WithoutOptional<Target>>(format, text);
    });
}

/// Puts the text itself into `target`.
template <typename Target>
[[nodiscard]] Take into(Target& target)
{
    return into(target, [](const std::string& text) -> base::Result<std::string> { return text; });
}

/// Adds the text to `target`: for options that may be given several times.
[[nodiscard]] inline Take onto(std::vector<std::string>& target)
{
    return [&target](const std::string& text) -> base::Result<void> {
        target.push_back(text);
        return {};
    };
}

/// An option, a flag, or a positional argument of a command.
struct Option {
    std::string names; // "-s,--socket"; for a positional its name in usage lines: "PROFILE"
    std::string value; // name of its value: "TIME"; "" for a flag
    std::string help;
    Take take;
    std::string group = "Options"; // heading in --help
    std::string example{};         // for a required option: a value that could be given
    bool is_repeated = false;
    bool is_instead = false; // prints something instead of running: nothing else is required
    bool is_hidden = false;  // left out of --help, whose heading for the group says how it is made
    bool is_given = false;   // valid after parse()

    Option& required(std::string value_to_show)
    {
        example = std::move(value_to_show);
        return *this;
    }
    Option& repeated()
    {
        is_repeated = true;
        return *this;
    }
    Option& instead()
    {
        is_instead = true;
        return *this;
    }
    Option& under(std::string heading)
    {
        group = std::move(heading);
        return *this;
    }
    Option& hidden()
    {
        is_hidden = true;
        return *this;
    }

    [[nodiscard]] bool is_positional() const { return !names.starts_with('-'); }
    [[nodiscard]] bool is_flag() const { return value.empty() && !is_positional(); }
    [[nodiscard]] bool is_required() const { return !example.empty(); }
    /// The long name: "--socket".
    [[nodiscard]] std::string name() const { return names.substr(names.rfind(',') + 1); }
};

} // namespace hapnet::cli
