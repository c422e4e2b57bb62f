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

/// Takes the value of an option. The error says what is wrong with the text and what would be
/// right. Callers put the option's name in front of it.
using Take = std::function<base::Result<void>(const std::string& text)>;

/// Returns a Take that stores the result of `parse` in `target`. `parse` returns a base::Result.
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

/// Returns a Take that parses the text by a format and stores the value in `target`.
template <typename Target, typename Format>
requires base::FormatOf<Format, base::WithoutOptional<Target>>
[[nodiscard]] Take into(Target& target, Format format)
{
    return into(target, [format](const std::string& text) {
        return value_of<base::WithoutOptional<Target>>(format, text);
    });
}

/// Returns a Take that stores the text itself in `target`.
template <typename Target>
[[nodiscard]] Take into(Target& target)
{
    return into(target, [](const std::string& text) -> base::Result<std::string> { return text; });
}

/// Returns a Take that appends the text to `target`, for options that may be given several times.
[[nodiscard]] inline Take onto(std::vector<std::string>& target)
{
    return [&target](const std::string& text) -> base::Result<void> {
        target.push_back(text);
        return {};
    };
}

/// An option, a flag, or a positional argument of a command.
struct Option {
    std::string names; // for a positional, its name in usage lines: "PROFILE"
    std::string value; // name of its value: "TIME"; "" for a flag
    std::string help;
    Take take;
    std::string group = "Options"; // heading in --help
    std::string example{};         // for a required option: a value that could be given
    bool is_repeated = false;
    bool is_instead = false; // prints something instead of running; no other option is required
    bool is_hidden = false;  // left out of --help; the heading of its group describes it
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
    /// Returns the long name: "--socket".
    [[nodiscard]] std::string name() const { return names.substr(names.rfind(',') + 1); }
};

} // namespace hapnet::cli
