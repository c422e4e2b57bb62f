// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/condition.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/reading.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <vector>

namespace hapnet::base {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t path_bytes_max = 200;

/// The longer signs first: ">=" begins as ">" does.
constexpr std::array comparisons{Comparison::at_most, Comparison::at_least, Comparison::equal,
                                 Comparison::unequal, Comparison::less,     Comparison::more};

std::string_view without_blanks(std::string_view text)
{
    const auto first = text.find_first_not_of(' ');
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::optional<double> number_in(std::string_view text)
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

std::vector<std::string_view> keys_of(const Json& object)
{
    std::vector<std::string_view> keys;
    for (auto member = object.begin(); member != object.end(); ++member) {
        keys.push_back(member.key());
    }
    return keys;
}

/// What the path leads to: null where it goes on below a null, whose parts are still to come. The
/// error names the keys where it leads astray.
Result<const Json*> find(std::string_view path, const Json& statistics)
{
    const Json* place = &statistics;
    std::string passed;
    while (place->is_object()) {
        const auto dot = path.find('.');
        const std::string key{path.substr(0, dot)};
        const auto next = place->find(key);
        if (next == place->end()) {
            return fail(fmt::format("there is no '{}' in {}: {}", key,
                                    passed.empty() ? "the statistics" : passed,
                                    suggestion(key, keys_of(*place))));
        }
        passed += (passed.empty() ? "" : ".") + key;
        place = &*next;
        if (dot == std::string_view::npos) break;
        path.remove_prefix(dot + 1);
        if (place->is_null()) return place;
        if (!place->is_object()) {
            return fail(fmt::format("'{}' is a single value, without parts", passed));
        }
    }
    if (place->is_object()) {
        return fail(fmt::format("'{}' has parts: name one of {}", passed,
                                fmt::join(keys_of(*place), ", ")));
    }
    return place;
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

Result<Condition> parse_condition(std::string_view text)
{
    const auto at = text.find_first_of("<>=!");
    if (at != std::string_view::npos) {
        const auto path = without_blanks(text.substr(0, at));
        for (const Comparison comparison : comparisons) {
            const auto sign = to_text(comparison);
            if (!text.substr(at).starts_with(sign)) continue;
            const auto number = number_in(without_blanks(text.substr(at + sign.size())));
            if (!number || path.empty() || path.size() > path_bytes_max) break;
            return Condition{std::string{path}, comparison, *number};
        }
    }
    return fail(fmt::format("'{}' is not a condition such as up.received>1000: a key of the "
                            "statistics, one of < <= == != >= >, and a number, true or false",
                            text));
}

std::string to_text(const Condition& condition)
{
    return fmt::format("{}{}{}", condition.path, to_text(condition.comparison), condition.number);
}

Result<std::optional<double>> value_in(const Json& statistics, const Condition& condition)
{
    const auto found = find(condition.path, statistics);
    if (!found) return tl::unexpected{found.error()};
    const Json& value = **found;
    if (value.is_null()) return std::optional<double>{};
    if (value.is_boolean()) return std::optional{value.get<bool>() ? 1.0 : 0.0};
    if (value.is_number()) return std::optional{value.get<double>()};
    return fail(fmt::format("'{}' is not a number", condition.path));
}

Result<bool> is_met(const Condition& condition, const Json& statistics)
{
    return value_in(statistics, condition).map([&](std::optional<double> value) {
        return value && holds(*value, condition.comparison, condition.number);
    });
}

} // namespace hapnet::base
