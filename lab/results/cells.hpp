// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace hapnet::lab {

// The cells of a CSV.

/// In thousandths of the unit ("mm" of metres); three decimals, empty when there is none.
[[nodiscard]] std::string milli_cell(std::optional<double> value);
/// Four decimals, empty when there is none.
[[nodiscard]] std::string number_cell(std::optional<double> value);
/// In quotes (RFC 4180).
[[nodiscard]] std::string quoted_cell(std::string_view text);
/// In quotes where it needs them.
[[nodiscard]] std::string text_cell(std::string_view text);

/// A CSV without quoted cells as a table for people: columns of equal width.
[[nodiscard]] std::string aligned(std::string_view csv);

} // namespace hapnet::lab
