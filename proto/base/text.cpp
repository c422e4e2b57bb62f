// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/text.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <spdlog/fmt/fmt.h>

namespace hapnet::base {

namespace {

struct Unit {
    std::string_view name;
    double nanoseconds;
};

constexpr std::array<Unit, 5> units{{
    {"ns", 1.0},
    {"us", 1e3},
    {"ms", 1e6},
    {"s", 1e9},
    {"min", 60e9},
}};

struct Quantity {
    std::string_view digits;
    std::string_view unit;
};

/// "160ms" into "160" and "ms".
Quantity split(std::string_view text)
{
    const auto end = std::min(text.find_first_not_of("0123456789."), text.size());
    return {text.substr(0, end), text.substr(end)};
}

/// The double nearest to `digits` times 10^exponent. Plain decimals: no sign, no exponent of
/// their own, no inf or nan.
std::optional<double> number(std::string_view digits, int exponent = 0)
{
    const auto text = fmt::format("{}e{}", digits, exponent);
    double value = 0.0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || rest != text.data() + text.size()) return std::nullopt;
    return value;
}

} // namespace

Result<Duration> parse_duration(std::string_view text)
{
    const auto [digits, unit_name] = split(text);
    const auto count = number(digits);
    const auto expected = [&] {
        return fail(fmt::format(
            "'{}' is not a duration: write a number and its unit, such as 160ms, 15us or 1.5s",
            text));
    };
    if (!count) return expected();
    if (unit_name.empty() && *count == 0.0) return Duration{0};
    for (const Unit& unit : units) {
        if (unit.name != unit_name) continue;
        const double nanoseconds = *count * unit.nanoseconds;
        if (nanoseconds > 1e15) return fail(fmt::format("'{}' is longer than 10^6 s", text));
        return Duration{std::llround(nanoseconds)};
    }
    return expected();
}

std::string to_text(Duration duration)
{
    const auto count = duration.count();
    if (count == 0) return "0ms";
    if (count % 1'000'000'000 == 0) return fmt::format("{}s", count / 1'000'000'000);
    if (count % 1'000'000 == 0) return fmt::format("{}ms", count / 1'000'000);
    if (count % 1'000 == 0) return fmt::format("{}us", count / 1'000);
    return fmt::format("{}ns", count);
}

Result<Probability> parse_probability(std::string_view text)
{
    const auto [digits, unit] = split(text);
    // Shifted as a decimal, not divided: every fraction can be written, and rounds once.
    const auto fraction = number(digits, -2);
    if (fraction && (unit == "%" || (unit.empty() && *fraction == 0.0))) {
        if (const auto probability = Probability::from_fraction(*fraction)) return *probability;
        return fail(fmt::format("'{}' is more than 100%", text));
    }
    return fail(fmt::format("'{}' is not a share: write a number from 0% to 100%", text));
}

std::string to_text(Probability probability)
{
    // Percent with the fewest decimals that read as the same fraction again. A long double holds
    // the product closely enough for any of them.
    const long double percent = 100.0L * static_cast<long double>(probability.fraction());
    constexpr int decimals_max = 400; // more than the smallest double needs
    for (int decimals = 0; decimals < decimals_max; ++decimals) {
        auto text = fmt::format("{:.{}f}%", percent, decimals);
        const auto again = parse_probability(text);
        if (again && *again == probability) return text;
    }
    ensure(false);
    return {};
}

Result<std::uint64_t> parse_count(std::string_view text, std::uint64_t most)
{
    std::uint64_t count = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (error == std::errc::invalid_argument || rest != text.data() + text.size()) {
        return fail(fmt::format("'{}' is not a whole number", text));
    }
    if (error != std::errc{} || count > most) {
        return fail(fmt::format("'{}' is more than {}", text, most));
    }
    return count;
}

} // namespace hapnet::base
