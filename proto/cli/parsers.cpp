// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/cli/parsers.hpp"

#include "proto/base/reading.hpp"
#include "proto/base/text.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <limits>
#include <spdlog/fmt/fmt.h>

namespace hapnet::cli {

namespace {

/// `value` if it lies within the range, whose ends are words.
template <typename T>
base::Result<T> within(T value, T min, T max, const std::string& text, const std::string& range)
{
    if (value >= min && value <= max) return value;
    return base::fail(fmt::format("'{}' is out of range: write {}", text, range));
}

std::string small(std::string_view text)
{
    std::string out;
    for (const char c : text) out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

} // namespace

Parser<std::uint64_t> whole_number(std::uint64_t min, std::uint64_t max)
{
    return [min, max](const std::string& text) -> base::Result<std::uint64_t> {
        const auto range = fmt::format("{} to {}", min, max);
        const auto value = base::parse_count(text, std::numeric_limits<std::uint64_t>::max());
        if (!value) return base::fail(fmt::format("{}: write {}", value.error().message, range));
        return within(*value, min, max, text, range);
    };
}

Parser<double> number(double min, double max)
{
    return [min, max](const std::string& text) -> base::Result<double> {
        const auto range = fmt::format("{} to {}", min, max);
        double value = 0.0;
        const char* end = text.data() + text.size();
        const auto [rest, trouble] = std::from_chars(text.data(), end, value);
        if (trouble != std::errc{} || rest != end) {
            return base::fail(fmt::format("'{}' is not a number: write {}", text, range));
        }
        return within(value, min, max, text, range);
    };
}

Parser<base::Duration> duration(base::Duration min, base::Duration max)
{
    return [min, max](const std::string& text) -> base::Result<base::Duration> {
        const auto value = base::parse_duration(text);
        if (!value) return value;
        return within(*value, min, max, text,
                      fmt::format("{} to {}", base::to_text(min), base::to_text(max)));
    };
}

Parser<base::Duration> duration(base::Duration min)
{
    return [min](const std::string& text) -> base::Result<base::Duration> {
        const auto value = base::parse_duration(text);
        if (!value) return value;
        return within(*value, min, base::Duration::max(), text,
                      fmt::format("at least {}", base::to_text(min)));
    };
}

Parser<double> quantity(const base::QuantityKind& kind, double min, double max)
{
    return [&kind, min, max](const std::string& text) -> base::Result<double> {
        const auto value = base::parse_quantity(text, kind);
        if (!value) return value;
        return within(*value, min, max, text,
                      fmt::format("{} to {}", base::quantity_text(min, kind),
                                  base::quantity_text(max, kind)));
    };
}

base::Result<base::Seed> seed(const std::string& text)
{
    return base::parse_count(text, std::numeric_limits<std::uint64_t>::max())
        .map([](std::uint64_t value) { return base::Seed{value}; });
}

Parser<std::string> one_of(std::vector<std::string> words)
{
    return [words = std::move(words)](const std::string& text) -> base::Result<std::string> {
        const auto word = std::find_if(words.begin(), words.end(), [&](const std::string& one) {
            return small(one) == small(text);
        });
        if (word != words.end()) return *word;
        return base::fail(
            fmt::format("'{}' is not known here: write {}", text, fmt::join(words, ", ")));
    };
}

} // namespace hapnet::cli
