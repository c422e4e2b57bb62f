// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/text.hpp"

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
    double number;
    std::string_view unit;
};

/// "160ms" into 160 and "ms". Plain decimals: no sign, no exponent, no inf or nan.
std::optional<Quantity> split(std::string_view text)
{
    const auto end = text.find_first_not_of("0123456789.");
    const std::string_view digits = text.substr(0, end);
    Quantity quantity{0.0, end == std::string_view::npos ? std::string_view{} : text.substr(end)};
    const auto [rest, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), quantity.number);
    if (error != std::errc{} || rest != digits.data() + digits.size()) return std::nullopt;
    return quantity;
}

} // namespace

Result<Duration> parse_duration(std::string_view text)
{
    const auto quantity = split(text);
    const auto expected = [&] {
        return fail(fmt::format(
            "'{}' is not a duration: write a number and its unit, such as 160ms, 15us or 1.5s",
            text));
    };
    if (!quantity) return expected();
    if (quantity->unit.empty() && quantity->number == 0.0) return Duration{0};
    for (const Unit& unit : units) {
        if (unit.name != quantity->unit) continue;
        const double nanoseconds = quantity->number * unit.nanoseconds;
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
    const auto quantity = split(text);
    if (quantity && (quantity->unit == "%" || (quantity->unit.empty() && quantity->number == 0))) {
        if (const auto probability = Probability::from_fraction(quantity->number / 100.0)) {
            return *probability;
        }
        return fail(fmt::format("'{}' is more than 100%", text));
    }
    return fail(fmt::format("'{}' is not a share: write a number from 0% to 100%", text));
}

std::string to_text(Probability probability)
{
    // Percent with the fewest digits that give the same fraction again.
    for (int digits = 1; digits < 17; ++digits) {
        auto text = fmt::format("{:.{}g}%", probability.percent(), digits);
        if (text.find('e') != std::string::npos) continue;
        const auto again = parse_probability(text);
        if (again && *again == probability) return text;
    }
    return fmt::format("{:.17f}%", probability.percent());
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
