// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"
#include "proto/base/probability.hpp"
#include "proto/base/time.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <optional>
#include <utility>
#include <variant>

namespace hapnet::base {

// Ramps. between() returns the value at `progress` from 0 (a) to 1 (b); nullopt if there is none.

[[nodiscard]] inline std::optional<double> between(double a, double b, double progress)
{
    return a + (b - a) * progress;
}

[[nodiscard]] inline std::optional<Duration> between(Duration a, Duration b, double progress)
{
    return a + Duration{std::llround(static_cast<double>((b - a).count()) * progress)};
}

[[nodiscard]] inline std::optional<Probability> between(Probability a, Probability b,
                                                        double progress)
{
    const double fraction = a.fraction() + (b.fraction() - a.fraction()) * progress;
    return Probability::from_fraction(std::clamp(fraction, 0.0, 1.0));
}

/// An unsigned integer that counts things. A single byte, used for small codes, and bool are
/// excluded.
template <typename T>
concept Whole = std::unsigned_integral<T> && sizeof(T) > 1;

template <Whole T>
[[nodiscard]] std::optional<T> between(T a, T b, double progress)
{
    const auto from = static_cast<double>(a);
    return static_cast<T>(std::llround(from + (static_cast<double>(b) - from) * progress));
}

/// Values of a type without intermediate values have a ramp only if both are equal.
template <typename T>
requires(!Described<T> && !Whole<T>)
    [[nodiscard]] std::optional<T> between(const T& a, const T& b, double /*progress*/)
{
    return a == b ? std::optional<T>{b} : std::nullopt;
}

template <typename T>
[[nodiscard]] std::optional<std::optional<T>> between(const std::optional<T>& a,
                                                      const std::optional<T>& b, double progress)
{
    using Between = std::optional<std::optional<T>>;
    if (!a || !b) return a == b ? Between{std::in_place, b} : Between{};
    const auto value = between(*a, *b, progress);
    return value ? Between{std::in_place, *value} : Between{};
}

/// A variant has a ramp only if both values have the same alternative.
template <typename... Types>
[[nodiscard]] std::optional<std::variant<Types...>>
between(const std::variant<Types...>& a, const std::variant<Types...>& b, double progress);

/// Returns a point of a ramp for each field of a struct.
template <Described T>
[[nodiscard]] std::optional<T> between(const T& a, const T& b, double progress)
{
    T result = b;
    bool is_possible = true;
    for_each_field(
        [&](const auto& /*field*/, auto& target, const auto& from, const auto& to) {
            const auto value = between(from, to, progress);
            is_possible = is_possible && value.has_value();
            if (value) target = *value;
        },
        result, a, b);
    return is_possible ? std::optional<T>{result} : std::nullopt;
}

template <typename... Types>
std::optional<std::variant<Types...>> between(const std::variant<Types...>& a,
                                              const std::variant<Types...>& b, double progress)
{
    if (a.index() != b.index()) return std::nullopt;
    return std::visit(
        [&]<typename Own>(const Own& to) -> std::optional<std::variant<Types...>> {
            auto value = between(std::get<Own>(a), to, progress);
            if (!value) return std::nullopt;
            return *std::move(value);
        },
        b);
}

} // namespace hapnet::base
