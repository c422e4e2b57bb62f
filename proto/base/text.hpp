// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/probability.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace hapnet::base {

// Quantities in the notation for people. Units are required, except with a bare 0. Every printed
// text parses to the value that it was printed from.

/// Parses "160ms", "15us", "1.5s", "250ns", "2min" or "1h"; not negative, at most 10^6 s.
[[nodiscard]] Result<Duration> parse_duration(std::string_view text);
[[nodiscard]] std::string to_text(Duration duration);
/// Returns the bound of a range for an error: 24h, where to_text() prints 86400s.
[[nodiscard]] std::string bound_text(Duration bound);

/// Parses a duration with an optional sign: "-5ms".
[[nodiscard]] Result<Duration> parse_signed_duration(std::string_view text);

/// Parses "93%" or "0.5%"; from 0% to 100%.
[[nodiscard]] Result<Probability> parse_probability(std::string_view text);
[[nodiscard]] std::string to_text(Probability probability);

/// Parses bits per second: "10Mbit/s", "64kbit/s", also "10Mbit"; whole bits, at most 1Tbit/s.
[[nodiscard]] Result<std::uint64_t> parse_bit_rate(std::string_view text);
[[nodiscard]] std::string bit_rate_text(std::uint64_t bits_per_second);

/// Parses bytes: "1500B", "64KiB", "1.5MB"; whole bytes, at most 1TiB.
[[nodiscard]] Result<std::uint64_t> parse_size(std::string_view text);
[[nodiscard]] std::string size_text(std::uint64_t bytes);

/// Returns `80ms` for `80 ms`. A space before the unit is the most common mistake, so the errors
/// mention it.
[[nodiscard]] std::string without_spaces(std::string_view text);

/// Parses a whole number from 0 to `most`, in decimal digits only.
[[nodiscard]] Result<std::uint64_t> parse_count(std::string_view text, std::uint64_t most);

} // namespace hapnet::base
