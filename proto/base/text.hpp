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

// Quantities as people type and read them. Units are mandatory, except that a bare 0 is zero.
// Every printed text parses to the value it was printed from.

/// "160ms", "15us", "1.5s", "250ns", "2min"; not negative, at most 10^6 s.
[[nodiscard]] Result<Duration> parse_duration(std::string_view text);
[[nodiscard]] std::string to_text(Duration duration);

/// "93%", "0.5%"; from 0% to 100%.
[[nodiscard]] Result<Probability> parse_probability(std::string_view text);
[[nodiscard]] std::string to_text(Probability probability);

/// A whole number from 0 to `most`, decimal digits only.
[[nodiscard]] Result<std::uint64_t> parse_count(std::string_view text, std::uint64_t most);

} // namespace hapnet::base
