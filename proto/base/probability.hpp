// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

namespace hapnet::base {

/// A number from 0 to 1. Percentages are used only in text for people.
class Probability {
public:
    constexpr Probability() = default;

    /// Returns nullopt unless 0 <= fraction <= 1.
    [[nodiscard]] static constexpr std::optional<Probability> from_fraction(double fraction)
    {
        if (!(fraction >= 0.0 && fraction <= 1.0)) return std::nullopt;
        return Probability{fraction};
    }

    [[nodiscard]] constexpr double fraction() const { return fraction_; }
    [[nodiscard]] constexpr double percent() const { return fraction_ * 100.0; }

    friend constexpr auto operator<=>(Probability, Probability) = default;

private:
    explicit constexpr Probability(double fraction) : fraction_{fraction} {}

    double fraction_ = 0.0;
};

namespace literals {

/// The literal `93_percent`. A value above 100, such as `150_percent`, does not compile.
consteval Probability operator""_percent(long double percent)
{
    return Probability::from_fraction(static_cast<double>(percent / 100.0L)).value();
}
consteval Probability operator""_percent(unsigned long long percent)
{
    return Probability::from_fraction(static_cast<double>(percent) / 100.0).value();
}

} // namespace literals

} // namespace hapnet::base
