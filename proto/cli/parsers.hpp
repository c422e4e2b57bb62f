// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/quantity.hpp"
#include "proto/base/random.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::cli {

// Parsers for options, beside those of proto/base/text.hpp. Errors quote the text and say what is
// possible.

template <typename T>
using Parser = std::function<base::Result<T>(const std::string& text)>;

/// A whole number within a range.
[[nodiscard]] Parser<std::uint64_t> whole_number(std::uint64_t min, std::uint64_t max);

/// A number without a unit within a range.
[[nodiscard]] Parser<double> number(double min, double max);

/// A time within a range.
[[nodiscard]] Parser<base::Duration> duration(base::Duration min, base::Duration max);

/// A time of at least `min`.
[[nodiscard]] Parser<base::Duration> duration(base::Duration min);

/// A quantity within a range, in SI units.
[[nodiscard]] Parser<double> quantity(const base::QuantityKind& kind, double min, double max);

[[nodiscard]] base::Result<base::Seed> seed(const std::string& text);

/// One of some words, small or capital letters alike.
[[nodiscard]] Parser<std::string> one_of(std::vector<std::string> words);

} // namespace hapnet::cli
