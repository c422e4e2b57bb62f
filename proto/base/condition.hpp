// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace hapnet::base {

enum class Comparison : std::uint8_t { less, at_most, equal, unequal, at_least, more };
[[nodiscard]] std::string_view to_text(Comparison comparison);

/// A comparison with a figure of the statistics: "up.received>1000", "down.dropped.random_loss >=
/// 5", "valid == true" (true counts as 1, false as 0).
struct Condition {
    std::string path; // keys, separated by dots
    Comparison comparison = Comparison::more;
    double number = 0.0; // finite

    friend bool operator==(const Condition&, const Condition&) = default;
};

/// Parses a condition. The error quotes `example`, a condition of the expected kind.
[[nodiscard]] Result<Condition> parse_condition(std::string_view text,
                                                std::string_view example = "up.received>1000");
[[nodiscard]] std::string to_text(const Condition& condition);

/// True if the value meets the condition.
[[nodiscard]] bool holds(const Condition& condition, double value);

} // namespace hapnet::base
