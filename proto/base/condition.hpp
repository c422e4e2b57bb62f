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

/// A statement about the statistics: "up.received>1000", "down.dropped.random_loss >= 5",
/// "valid == true" (a truth is 1 or 0).
struct Condition {
    std::string path; // keys with dots between them
    Comparison comparison = Comparison::more;
    double number = 0.0; // finite

    friend bool operator==(const Condition&, const Condition&) = default;
};

/// `example`: a condition of the kind that is asked for, for the error.
[[nodiscard]] Result<Condition> parse_condition(std::string_view text,
                                                std::string_view example = "up.received>1000");
[[nodiscard]] std::string to_text(const Condition& condition);

/// True if a value meets the condition.
[[nodiscard]] bool holds(const Condition& condition, double value);

} // namespace hapnet::base
