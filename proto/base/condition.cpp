// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/condition.hpp"

#include "proto/base/ensure.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <spdlog/fmt/fmt.h>

namespace hapnet::base {

namespace {

constexpr std::size_t path_bytes_max = 200;

/// Longer operators come first, because ">=" begins with ">".
constexpr std::array comparisons{Comparison::at_most, Comparison::at_least, Comparison::equal,
                                 Comparison::unequal, Comparison::less,     Comparison::more};

std::string_view without_blanks(std::string_view text)
{
    const auto first = text.find_first_not_of(' ');
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::optional<double> limit_in(std::string_view text)
{
    if (text == "true") return 1.0;
    if (text == "false") return 0.0;
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return std::isfinite(number) ? std::optional{number} : std::nullopt;
}

bool holds(double left, Comparison comparison, double right)
{
    switch (comparison) {
    case Comparison::less: return left < right;
    case Comparison::at_most: return left <= right;
    case Comparison::equal: return left == right;
    case Comparison::unequal: return left != right;
    case Comparison::at_least: return left >= right;
    case Comparison::more: return left > right;
    }
    ensure(false);
    return false;
}

} // namespace

std::string_view to_text(Comparison comparison)
{
    switch (comparison) {
    case Comparison::less: return "<";
    case Comparison::at_most: return "<=";
    case Comparison::equal: return "==";
    case Comparison::unequal: return "!=";
    case Comparison::at_least: return ">=";
    case Comparison::more: return ">";
    }
    ensure(false);
    return {};
}

Result<Condition> parse_condition(std::string_view text, std::string_view example)
{
    const auto at = text.find_first_of("<>=!");
    if (at != std::string_view::npos) {
        const auto path = without_blanks(text.substr(0, at));
        for (const Comparison comparison : comparisons) {
            const auto sign = to_text(comparison);
            if (!text.substr(at).starts_with(sign)) continue;
            const auto number = limit_in(without_blanks(text.substr(at + sign.size())));
            if (!number || path.empty() || path.size() > path_bytes_max) break;
            return Condition{std::string{path}, comparison, *number};
        }
    }
    return fail(fmt::format("'{}' is not a condition such as {}: a key, one of "
                            "< <= == != >= >, and a number, true or false",
                            text, example));
}

std::string to_text(const Condition& condition)
{
    return fmt::format("{}{}{}", condition.path, to_text(condition.comparison), condition.number);
}

bool holds(const Condition& condition, double value)
{
    return holds(value, condition.comparison, condition.number);
}

} // namespace hapnet::base
