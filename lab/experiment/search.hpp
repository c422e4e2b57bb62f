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

inline constexpr std::uint32_t scan_seeds = 4;   // seeds at each level of a coarse scan
inline constexpr std::size_t counted_levels = 8; // levels across the range that a scan found
/// The number of levels that are added below or above before their distance doubles.
inline constexpr std::size_t further_levels = 8;

/// The levels that count, ascending: at each all seeds are played.
///
/// A coarse scan with a few seeds looks for the range in which sessions begin to fail: upward from
/// `from` in steps (from 0 when `from` itself has failures), to the first level at which all fail;
/// then with smaller steps between the last level without failures and that one. It does not count.
/// Eight levels lie across what it found, a multiple of `resolution` apart. While more than a tenth
/// of all seeds fails at the lowest of them, lower ones are added; while less than half fails at
/// the highest, higher ones: eight at the same distance, and each after those twice as far on as
/// the one before, down to 0 or up to `to`. When nothing fails in the scan, nor with all seeds at
/// `to`, that is the only level.
[[nodiscard]] base::Result<std::vector<ImpairmentLevel>>
levels_to_count(const SearchRange& range, std::uint32_t seeds, const Failures& failures);

} // namespace hapnet::lab::experiment
