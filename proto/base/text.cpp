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

/// A unit of a quantity that is counted in whole numbers.
struct WholeUnit {
    std::string_view name;
    std::uint64_t size;
};

constexpr std::array<Unit, 12> units{{
    {"ns", 1.0},
    {"us", 1e3},
    {"ms", 1e6},
    {"s", 1e9},
    {"min", 60e9},
    {"h", 3600e9},
    // Spellings of tc and other programs.
    {"usec", 1e3},
    {"usecs", 1e3},
    {"msec", 1e6},
    {"msecs", 1e6},
    {"sec", 1e9},
    {"secs", 1e9},
}};

constexpr std::uint64_t most_bits_per_second = 1'000'000'000'000;
constexpr std::array<WholeUnit, 11> rate_units{{
    {"Tbit", 1'000'000'000'000},
    {"Gbit", 1'000'000'000},
    {"Mbit", 1'000'000},
    {"kbit", 1'000},
    {"bit", 1},
    // Other spellings, which are never printed. All rates are whole numbers of bits per second.
    {"tbit", 1'000'000'000'000},
    {"gbit", 1'000'000'000},
    {"mbit", 1'000'000},
    {"Kbit", 1'000},
    {"kbit/sec", 1'000},
    {"Mbit/sec", 1'000'000},
}};

constexpr std::uint64_t most_bytes = 1ULL << 40;
constexpr std::array<WholeUnit, 8> size_units{{
    {"TiB", 1ULL << 40},
    {"GiB", 1ULL << 30},
    {"MiB", 1ULL << 20},
    {"KiB", 1ULL << 10},
    {"GB", 1'000'000'000},
    {"MB", 1'000'000},
    {"kB", 1'000},
    {"B", 1},
}};

struct NumberAndUnit {
    std::string_view digits;
    std::string_view unit;
};

/// Splits "160ms" into "160" and "ms".
NumberAndUnit split(std::string_view text)
{
    const auto end = std::min(text.find_first_not_of("0123456789."), text.size());
    return {text.substr(0, end), text.substr(end)};
}

/// Returns the double nearest to `digits` times 10^exponent. `digits` is a plain decimal number: no
/// sign, no exponent, no inf or nan.
std::optional<double> number(std::string_view digits, int exponent = 0)
{
    const auto text = fmt::format("{}e{}", digits, exponent);
    double value = 0.0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || rest != text.data() + text.size()) return std::nullopt;
    return value;
}

/// Converts the quantity to a whole number of the smallest unit; nullopt if it is not whole, or the
/// unit is not one of `whole_units`.
template <std::size_t N>
std::optional<std::uint64_t> whole(const NumberAndUnit& quantity,
                                   const std::array<WholeUnit, N>& whole_units)
{
    const auto count = number(quantity.digits);
    if (!count) return std::nullopt;
    if (quantity.unit.empty() && *count == 0.0) return 0;
    for (const WholeUnit& unit : whole_units) {
        if (unit.name != quantity.unit) continue;
        constexpr double exact_max = 9e15; // every whole number below is a double
        const double value = std::round(*count * static_cast<double>(unit.size));
        const bool is_whole = std::abs(value - *count * static_cast<double>(unit.size)) < 1e-3;
        if (!is_whole || value > exact_max) return std::nullopt;
        return static_cast<std::uint64_t>(value);
    }
    return std::nullopt;
}

/// Refuses `text`. If it would be valid without spaces, the error says so; otherwise the error is
/// `why`.
template <typename Parse>
tl::unexpected<Error> refuse(std::string_view text, Parse parse, std::string why)
{
    const std::string joined = without_spaces(text);
    if (joined.size() == text.size() || !parse(joined)) return fail(std::move(why));
    return fail(fmt::format("'{}' has a space: write {}", text, joined));
}

/// Returns "k" for "kbps", in the case of the units above; nullopt if it is not such a unit.
/// Programs differ in whether it means bits or bytes, and its case does not tell.
std::optional<std::string> prefix_of_bps(std::string_view unit)
{
    std::string small;
    for (const char c : unit) small += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    if (small == "bps") return "";
    if (small == "kbps") return "k";
    if (small == "mbps") return "M";
    if (small == "gbps") return "G";
    if (small == "tbps") return "T";
    return std::nullopt;
}

/// Prints a count in the largest unit of which it is a whole number.
template <std::size_t N>
std::string whole_text(std::uint64_t value, const std::array<WholeUnit, N>& whole_units)
{
    for (const WholeUnit& unit : whole_units) {
        if (value > 0 && value % unit.size != 0) continue;
        if (value == 0 && unit.size > 1) continue;
        return fmt::format("{}{}", value / unit.size, unit.name);
    }
    ensure(false);
    return {};
}

} // namespace

std::string without_spaces(std::string_view text)
{
    std::string joined{text};
    std::erase(joined, ' ');
    return joined;
}

Result<Duration> parse_duration(std::string_view text)
{
    const auto [digits, unit_name] = split(text);
    const auto count = number(digits);
    const auto expected = [&] {
        return refuse(text, parse_duration,
                      fmt::format("'{}' is not a duration: write a number and its unit, such as "
                                  "160ms, 15us or 1.5s",
                                  text));
    };
    if (!count) return expected();
    if (unit_name == "m") {
        return fail(fmt::format("'{0}' may be minutes or milliseconds: write {1}min or {1}ms", text,
                                digits));
    }
    if (unit_name.empty() && *count == 0.0) return Duration{0};
    for (const Unit& unit : units) {
        if (unit.name != unit_name) continue;
        const double nanoseconds = *count * unit.nanoseconds;
        if (nanoseconds > 1e15) return fail(fmt::format("'{}' is longer than 10^6 s", text));
        return Duration{std::llround(nanoseconds)};
    }
    const bool is_word = std::all_of(unit_name.begin(), unit_name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    });
    if (unit_name.empty())
        return fail(fmt::format("'{0}' has no unit: write {0}ms, {0}us or {0}s", text));
    if (!is_word) return expected();
    return fail(fmt::format("'{}' is not a duration: '{}' is not a unit of time: use ns, us, ms, "
                            "s, min or h",
                            text, unit_name));
}

Result<Duration> parse_signed_duration(std::string_view text)
{
    const bool is_negative = text.starts_with('-');
    auto size = parse_duration(is_negative || text.starts_with('+') ? text.substr(1) : text);
    if (!size) return size;
    return is_negative ? -*size : *size;
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

std::string bound_text(Duration bound)
{
    constexpr Duration hour = std::chrono::hours{1};
    const bool is_hours = bound.count() != 0 && bound % hour == Duration{0};
    return is_hours ? fmt::format("{}h", bound / hour) : to_text(bound);
}

Result<Probability> parse_probability(std::string_view text)
{
    const auto [digits, unit] = split(text);
    // The decimal point is shifted instead of dividing, so that every fraction can be written and
    // is rounded once.
    const auto fraction = number(digits, -2);
    if (fraction && (unit == "%" || (unit.empty() && *fraction == 0.0))) {
        if (const auto probability = Probability::from_fraction(*fraction)) return *probability;
        return fail(fmt::format("'{}' is more than 100%", text));
    }
    if (const auto meant =
            unit.empty() && fraction ? Probability::from_fraction(*fraction) : std::nullopt) {
        const auto as_share = number(digits);
        const auto of_one = as_share ? Probability::from_fraction(*as_share) : std::nullopt;
        return fail(fmt::format("'{}' has no unit: write {}{}", text,
                                of_one ? to_text(*of_one) + " or " : "", to_text(*meant)));
    }
    return refuse(text, parse_probability,
                  fmt::format("'{}' is not a share: write a number from 0% to 100%", text));
}

std::string to_text(Probability probability)
{
    // Finds the percentage with the fewest decimals that reads as the same fraction. A long double
    // holds the product with sufficient precision.
    const long double percent = 100.0L * static_cast<long double>(probability.fraction());
    constexpr int decimals_max = 400; // more than the smallest double needs
    std::array<char, decimals_max + 8> buffer{};
    for (int decimals = 0; decimals < decimals_max; ++decimals) {
        // fmt is not used, because version 9 ignores the precision here (0.05L with 0 decimals).
        const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(),
                                                percent, std::chars_format::fixed, decimals);
        ensure(error == std::errc{});
        std::string text = std::string{buffer.data(), end} + '%';
        const auto again = parse_probability(text);
        if (again && *again == probability) return text;
    }
    ensure(false);
    return {};
}

Result<std::uint64_t> parse_bit_rate(std::string_view text)
{
    auto quantity = split(text);
    if (quantity.unit.ends_with("/s")) quantity.unit.remove_suffix(2);
    const auto prefix = prefix_of_bps(quantity.unit);
    if (prefix && number(quantity.digits)) {
        return fail(fmt::format("'{}' is a number of bytes to tc and of bits to others: write {}{}"
                                "bit/s for bits a second",
                                text, quantity.digits, *prefix));
    }
    const auto rate = whole(quantity, rate_units);
    if (!rate) {
        return refuse(text, parse_bit_rate,
                      fmt::format("'{}' is not a rate: write a number and its unit, such as "
                                  "10Mbit/s, 64kbit/s or 500bit/s",
                                  text));
    }
    if (*rate > most_bits_per_second) return fail(fmt::format("'{}' is more than 1Tbit/s", text));
    return *rate;
}

std::string bit_rate_text(std::uint64_t bits_per_second)
{
    return whole_text(bits_per_second, rate_units) + "/s";
}

Result<std::uint64_t> parse_size(std::string_view text)
{
    const auto size = whole(split(text), size_units);
    if (!size) {
        return refuse(
            text, parse_size,
            fmt::format(
                "'{}' is not a size: write a number and its unit, such as 1500B, 64KiB or 1MB",
                text));
    }
    if (*size > most_bytes) return fail(fmt::format("'{}' is more than 1TiB", text));
    return *size;
}

std::string size_text(std::uint64_t bytes) { return whole_text(bytes, size_units); }

Result<std::uint64_t> parse_count(std::string_view text, std::uint64_t most)
{
    std::uint64_t count = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (error == std::errc::invalid_argument || rest != text.data() + text.size()) {
        return fail(
            fmt::format("'{}' is not a whole number from 0 to {}: write digits only", text, most));
    }
    if (error != std::errc{} || count > most) {
        return fail(fmt::format("'{}' is more than {}", text, most));
    }
    return count;
}

} // namespace hapnet::base
