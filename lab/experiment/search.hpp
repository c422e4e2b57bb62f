// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/experiment.hpp"
#include "proto/base/result.hpp"

#include <cstdint>
#include <functional>
#include <vector>

namespace hapnet::lab::experiment {

/// Returns the number of the first `seeds` seeds that fail at a level. An error ends the search.
using Failures = std::function<base::Result<std::uint32_t>(ImpairmentLevel, std::uint32_t seeds)>;

inline constexpr std::uint32_t scan_seeds = 4;   // seeds at each level of the coarse scan
inline constexpr std::size_t counted_levels = 8; // levels across the range of the coarse scan
/// The number of levels that are added below or above before their distance doubles.
inline constexpr std::size_t further_levels = 8;

/// Returns the levels that count, ascending. At each of them all seeds are played.
///
/// A coarse scan with a few seeds looks for the range in which sessions begin to fail. It goes
/// upward from `from` in steps (from 0 when `from` itself has failures), to the first level at
/// which all fail. Then it goes with smaller steps from the last level without failures to that
/// one. The levels of the scan do not count. Eight levels are laid across the range that it found,
/// a multiple of `resolution` apart. While more than a tenth of all seeds fails at the lowest of
/// them, lower levels are added, down to 0. While less than half fails at the highest, higher
/// levels are added, up to `to`. The first eight that are added on a side have the same distance;
/// after those each distance is twice the one before. When nothing fails in the scan, nor with all
/// seeds at `to`, then `to` is the only level.
[[nodiscard]] base::Result<std::vector<ImpairmentLevel>>
levels_to_count(const SearchRange& range, std::uint32_t seeds, const Failures& failures);

} // namespace hapnet::lab::experiment
