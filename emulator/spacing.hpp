// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/formats.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"
#include "proto/cli/parsers.hpp"

#include <cmath>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <string_view>

namespace hapnet::emulator {

/// Parses a rate such as "1000" or "1000/s", at most 10^`most` a second, and returns the time
/// between two things. `what` names the things in the error.
[[nodiscard]] inline base::Result<base::Duration> parse_spacing(const std::string& text,
                                                                std::string_view what, int most)
{
    auto digits = text;
    if (digits.ends_with("/s")) digits.resize(digits.size() - 2);
    constexpr double slowest = 1e-3;
    const auto rate = cli::value_of<double>(base::Number{slowest, std::pow(10.0, most)}, digits);
    if (rate) return base::from_seconds(1.0 / *rate);
    return base::fail(fmt::format("'{}' is not a rate: write {} a second, such as 1000 or 1000/s; "
                                  "at most 10^{}",
                                  text, what, most));
}

} // namespace hapnet::emulator
