// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/quantity.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <utility>
#include <vector>

namespace hapnet::base {

namespace {

constexpr std::string_view digit_letters = "0123456789";

/// Returns the length of an exponent such as "e-3" at the start of `text`; 0 if there is none.
std::size_t exponent_size(std::string_view text)
{
    if (!text.starts_with('e') && !text.starts_with('E')) return 0;
    const std::size_t sign = text.size() > 1 && (text[1] == '-' || text[1] == '+') ? 1 : 0;
    const auto end = std::min(text.find_first_not_of(digit_letters, 1 + sign), text.size());
    return end > 1 + sign ? end : 0;
}

struct Written {
    std::string_view digits; // digits with their sign
    int exponent = 0;
    std::string_view unit;
};

/// Splits "-1.5e3N" into "-1.5", 3 and "N"; nullopt if the text does not have this form.
std::optional<Written> written_in(std::string_view text)
{
    const std::size_t sign = text.starts_with('-') ? 1 : 0;
    const auto end = std::min(text.find_first_not_of("0123456789.", sign), text.size());
    Written written{text.substr(0, end), 0, text.substr(end)};
    if (const std::size_t size = exponent_size(written.unit); size > 0) {
        auto power = written.unit.substr(1, size - 1);
        if (power.starts_with('+')) power.remove_prefix(1);
        const auto [rest, error] =
            std::from_chars(power.data(), power.data() + power.size(), written.exponent);
        constexpr int exponent_max = 10'000; // far beyond all doubles, without overflow in sums
        if (error != std::errc{} || std::abs(written.exponent) > exponent_max) return std::nullopt;
        written.unit.remove_prefix(size);
    }
    return written;
}

std::optional<double> shifted(std::string_view digits, int exponent)
{
    const auto text = fmt::format("{}e{}", digits, exponent);
    double value = 0.0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || rest != text.data() + text.size()) return std::nullopt;
    return value;
}

/// A decimal number: 0.d1d2d3... times 10^point.
struct Decimal {
    bool is_negative = false;
    std::string digits;
    int point = 0;
};

/// Returns the shortest decimal number that reads as `value`.
Decimal decimal_of(double value)
{
    std::array<char, 64> buffer{};
    const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                            std::chars_format::scientific);
    ensure(error == std::errc{});
    const std::string_view text{buffer.data(), static_cast<std::size_t>(end - buffer.data())};
    const auto mark = text.find('e');
    Decimal decimal{text.starts_with('-'), {}, 0};
    for (const char c : text.substr(0, mark)) {
        if (c >= '0' && c <= '9') decimal.digits += c;
    }
    auto power = text.substr(mark + 1);
    if (power.starts_with('+')) power.remove_prefix(1);
    std::from_chars(power.data(), power.data() + power.size(), decimal.point);
    ++decimal.point;
    return decimal;
}

/// Returns plain digits if they are short, otherwise digits with an exponent.
std::string text_of(const Decimal& decimal)
{
    constexpr int point_min = -3;
    constexpr int point_max = 12;
    const std::string_view digits = decimal.digits;
    const std::string_view sign = decimal.is_negative ? "-" : "";
    const int size = static_cast<int>(digits.size());
    const int point = decimal.point;
    if (point < point_min || point > point_max) {
        const std::string_view dot = size > 1 ? "." : "";
        return fmt::format("{}{}{}{}e{}", sign, digits.substr(0, 1), dot, digits.substr(1),
                           point - 1);
    }
    if (point <= 0) return fmt::format("{}0.{:0<{}}{}", sign, "", -point, digits);
    if (point >= size) return fmt::format("{}{:0<{}}", sign, digits, point);
    const auto whole = static_cast<std::size_t>(point);
    return fmt::format("{}{}.{}", sign, digits.substr(0, whole), digits.substr(whole));
}

/// Returns a number with each unit of the examples once: "40N/m or 40N/mm".
std::string with_units(std::string_view number, const QuantityKind& kind)
{
    std::vector<std::string> cures;
    std::string_view rest = kind.examples;
    while (!rest.empty()) {
        const auto end = std::min(rest.find_first_of(", "), rest.size());
        const auto example = written_in(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
        if (!example || example->digits.empty()) continue; // the word "or"
        std::string cure = fmt::format("{}{}", number, example->unit);
        if (std::ranges::find(cures, cure) == cures.end()) cures.push_back(std::move(cure));
    }
    if (cures.size() == 1) return cures.front();
    const std::string last = std::exchange(cures.back(), {});
    cures.pop_back();
    return fmt::format("{} or {}", fmt::join(cures, ", "), last);
}

} // namespace

Result<double> parse_quantity(std::string_view text, const QuantityKind& kind)
{
    const auto written = written_in(text);
    if (written && written->unit.empty()) {
        const auto value = shifted(written->digits, 0);
        if (value && *value == 0.0) return *value;
    }
    for (const PhysicalUnit& unit : kind.units) {
        if (!written || written->unit.empty() || unit.name != written->unit) continue;
        const auto value = shifted(written->digits, written->exponent + unit.exponent);
        if (value) return *value * unit.factor;
    }
    const std::string joined = without_spaces(text);
    if (joined.size() != text.size() && parse_quantity(joined, kind)) {
        return fail(fmt::format("'{}' has a space: write {}", text, joined));
    }
    if (written && written->unit.empty() && shifted(written->digits, 0)) {
        return fail(fmt::format("'{}' has no unit: write {}", text, with_units(text, kind)));
    }
    return fail(fmt::format("'{}' is not {}: write a number and its unit, such as {}", text,
                            kind.name, kind.examples));
}

bool is_unit(std::string_view word)
{
    if (word.empty() || word.find_first_of("-.0123456789") == 0) return false;
    const std::string one = fmt::format("1{}", word);
    if (parse_duration(one) || parse_probability(one) || parse_bit_rate(one) || parse_size(one)) {
        return true;
    }
    static constexpr std::array kinds{&length_kind,       &mass_kind,           &density_kind,
                                      &stiffness_kind,    &damping_kind,        &force_kind,
                                      &turn_kind,         &force_rate_kind,     &speed_kind,
                                      &acceleration_kind, &frequency_kind,      &angle_kind,
                                      &mobility_kind,     &power_kind,          &energy_kind,
                                      &torsion_kind,      &torsion_damping_kind};
    return std::any_of(kinds.begin(), kinds.end(), [&](const QuantityKind* kind) {
        return parse_quantity(one, *kind).has_value();
    });
}

std::string quantity_text(double value, const QuantityKind& kind)
{
    ensure(std::isfinite(value));
    Decimal decimal = decimal_of(value);
    const PhysicalUnit* chosen = &kind.units[0];
    for (const PhysicalUnit& unit : kind.units) {
        const bool is_enough = value == 0.0 || decimal.point > chosen->exponent;
        if (!is_enough && unit.is_printed) chosen = &unit;
    }
    decimal.point -= value == 0.0 ? 0 : chosen->exponent;
    return text_of(decimal) + std::string{chosen->name};
}

} // namespace hapnet::base
