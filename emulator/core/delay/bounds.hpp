// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <chrono>
#include <initializer_list>
#include <optional>
#include <string_view>

namespace hapnet::emulator {

/// The longest delay. A longer drawn value is cut to it.
inline constexpr base::Duration longest_delay = std::chrono::seconds{1'000'000};

/// The formats of parameters: around zero, and of a width.
inline constexpr base::Time any_delay{-longest_delay, longest_delay};
inline constexpr base::Time delay_width{base::Duration{0}, longest_delay};

/// Returns a quantile, rounded to nanoseconds and limited to +-longest_delay.
[[nodiscard]] base::Duration bounded(double nanoseconds);

/// Returns the nearest whole number of nanoseconds.
[[nodiscard]] base::Duration rounded(double nanoseconds);

/// The mean and the standard deviation of a law.
struct LawMoments {
    base::Duration mean{};
    std::optional<base::Duration> sd{}; // nullopt: infinite, or longer than any delay
};

// Requirements on a law's parameters. The errors follow the name of the setting.

[[nodiscard]] base::Result<void> require(bool condition, std::string_view words);

/// Requires each time of a law to be in the range of its field.
template <base::Described Law>
[[nodiscard]] base::Result<void> require_ranges(const Law& law)
{
    base::Result<void> result;
    base::for_each_field(
        [&](const auto& field, const auto& value) {
            if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, base::Duration>) {
                if (value >= field.format.min && value <= field.format.max) return;
                if (!result) return;
                result =
                    base::fail(fmt::format("{} must be {}", field.key, field.format.describe()));
            }
        },
        law);
    return result;
}

/// Returns the first error.
[[nodiscard]] base::Result<void> all(std::initializer_list<base::Result<void>> results);

} // namespace hapnet::emulator
